// Mouse and touch in the viewport while this page drives: a click on the floor is a goal, a drag with Shift gives its
// heading, too, and a drag on the robot pushes it. Everything else turns the camera.
import * as THREE from 'three';

/** Movement within which a press is a click (px). */
const CLICK = 5;
/** Impulse of a push per length of the drag, of a robot of the paper's mass (N·s/px). */
const IMPULSE = 0.12;
const PAPER_MASS = 73;
/** Duration of a push (s). */
const LASTS = 0.1;

export class PointerInput {
  constructor(viewport, { robot, goal, drives, walkTo, push }) {
    Object.assign(this, { viewport, robot, goal, drives, walkTo, push });
    const canvas = viewport.renderer.domElement;
    this.arrow = new THREE.ArrowHelper(new THREE.Vector3(1, 0, 0), new THREE.Vector3(), 1, 0xff8ad8, 0.1, 0.06);
    this.arrow.visible = false;
    viewport.scene.add(this.arrow);
    this.label = document.getElementById('push-label');
    canvas.addEventListener('pointerdown', (event) => this.#down(event), true);
    canvas.addEventListener('pointermove', (event) => this.#move(event), true);
    canvas.addEventListener('pointerup', (event) => this.#up(event), true);
    canvas.addEventListener('pointercancel', () => this.#end(), true);
  }

  #down(event) {
    // Two fingers move the camera: the press of the first one is no click.
    if (!event.isPrimary) {
      this.#end();
      return;
    }
    this.press = { x: event.clientX, y: event.clientY, at: null, floor: null };
    const robot = this.robot();
    if (event.button !== 0 || !robot) return;
    const [hit] = this.drives() ? this.viewport.ray(event).intersectObject(robot.group, true) : [];
    if (hit) {
      this.press.at = hit.point;
      this.press.joint = hit.object.userData.joint;
      this.viewport.controls.enabled = false;
    } else if (this.drives() && event.shiftKey) {
      this.press.floor = this.viewport.floorAt(event);
      this.viewport.controls.enabled = false;
    }
  }

  /** The push of a drag: its direction in the walk frame, and its impulse. */
  #pushOf(event) {
    const [dx, dy] = [event.clientX - this.press.x, event.clientY - this.press.y];
    const length = Math.hypot(dx, dy);
    const right = new THREE.Vector3(1, 0, 0).applyQuaternion(this.viewport.camera.quaternion).setZ(0).normalize();
    const away = new THREE.Vector3(-right.y, right.x, 0);
    const direction = right.multiplyScalar(dx).addScaledVector(away, -dy).normalize();
    return { direction, length, impulse: (IMPULSE * length * this.robot().drawing.mass) / PAPER_MASS };
  }

  #move(event) {
    if (!this.press) return;
    if (this.press.at) {
      const { direction, length, impulse } = this.#pushOf(event);
      if (length < CLICK) return;
      const size = this.viewport.size;
      this.arrow.position.copy(this.press.at);
      this.arrow.setDirection(direction);
      this.arrow.setLength(0.004 * length * size, 0.07 * size, 0.05 * size);
      this.arrow.visible = true;
      this.label.hidden = false;
      this.label.textContent = `${impulse.toFixed(1)} N·s`;
      this.label.style.left = `${event.clientX + 14}px`;
      this.label.style.top = `${event.clientY - 10}px`;
    } else if (this.press.floor) {
      const to = this.viewport.floorAt(event);
      if (to && this.#isDrag(event)) this.goal.show(this.press.floor.toArray(), this.#heading(to));
    }
  }

  #heading(to) {
    return Math.atan2(to.y - this.press.floor.y, to.x - this.press.floor.x);
  }

  #isDrag(event) {
    return Math.hypot(event.clientX - this.press.x, event.clientY - this.press.y) > CLICK;
  }

  #up(event) {
    const { press } = this;
    if (!press) return;
    if (press.at && this.#isDrag(event)) {
      const { direction, impulse } = this.#pushOf(event);
      this.push({ joint: press.joint, impulse: direction.multiplyScalar(impulse).toArray(), lasts_s: LASTS });
    } else if (press.floor && this.#isDrag(event)) {
      const to = this.viewport.floorAt(event);
      if (to) this.walkTo(press.floor.toArray(), this.#heading(to));
    } else if (!press.at && event.button === 0 && !this.#isDrag(event) && this.drives()) {
      const at = this.viewport.floorAt(event);
      if (at) this.walkTo(at.toArray(), null);
    }
    this.#end();
  }

  #end() {
    this.press = null;
    this.arrow.visible = false;
    this.label.hidden = true;
    this.viewport.controls.enabled = true;
  }
}
