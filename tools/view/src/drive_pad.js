// The drive pad: a disc on which a finger or the mouse gives the velocity ahead and aside, and a slider for turning.
// Both return to zero when they are released.

const BACKGROUND = '#1b222b';
const OUTLINE = '#3a4757';
const TEXT = '#8b98a8';
const AT_REST = '#4aa3df';
const DEFLECTED = '#5ad1a0';

export class DrivePad {
  /** `released` is called when the pad or the slider has returned to zero. */
  constructor(canvas, slider, released) {
    this.canvas = canvas;
    this.slider = slider;
    canvas.onpointerdown = (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.isHeld = true;
      this.#deflect(event);
    };
    canvas.onpointermove = (event) => this.isHeld && this.#deflect(event);
    slider.onpointerdown = () => { this.isTurned = true; };
    const release = () => {
      this.reset();
      released();
    };
    canvas.onpointerup = canvas.onpointercancel = release;
    slider.onpointerup = slider.onpointercancel = release;
    this.reset();
  }

  /** Ahead, left and turn, each within ±1. */
  get velocity() {
    return [...this.deflection, this.isTurned ? -Number(this.slider.value) : 0];
  }

  /** Returns both to zero, where they stay until they are pressed anew. */
  reset() {
    this.isHeld = this.isTurned = false;
    this.deflection = [0, 0];
    this.slider.value = 0;
    this.#draw();
  }

  #deflect(event) {
    const box = this.canvas.getBoundingClientRect();
    const radius = box.width / 2;
    const right = (event.clientX - box.left - radius) / (0.8 * radius);
    const down = (event.clientY - box.top - radius) / (0.8 * radius);
    const length = Math.max(1, Math.hypot(right, down));
    this.deflection = [-down / length, -right / length];
    this.#draw();
  }

  #draw() {
    const { canvas, deflection: [ahead, left] } = this;
    const pen = canvas.getContext('2d');
    const radius = canvas.width / 2;
    pen.clearRect(0, 0, canvas.width, canvas.height);
    pen.strokeStyle = OUTLINE;
    pen.lineWidth = 1.5;
    pen.beginPath();
    pen.arc(radius, radius, 0.8 * radius, 0, 2 * Math.PI);
    pen.fillStyle = BACKGROUND;
    pen.fill();
    pen.stroke();
    pen.beginPath();
    pen.moveTo(radius, 0.3 * radius);
    pen.lineTo(radius, 1.7 * radius);
    pen.moveTo(0.3 * radius, radius);
    pen.lineTo(1.7 * radius, radius);
    pen.stroke();
    pen.fillStyle = TEXT;
    pen.font = '10px system-ui, sans-serif';
    pen.textAlign = 'center';
    pen.fillText('ahead', radius, 0.15 * radius);
    pen.beginPath();
    pen.arc(radius - 0.8 * radius * left, radius - 0.8 * radius * ahead, 0.2 * radius, 0, 2 * Math.PI);
    pen.fillStyle = ahead || left ? DEFLECTED : AT_REST;
    pen.fill();
  }
}
