// Driving by keys, drive pad, sliders and gamepad: all of it becomes commands as lines of `halfstep stream`.
//
// While this page drives it sends a sign of life every few milliseconds. A page that is closed, hidden or cut off sends
// none, and the controller stops the robot after its command timeout.
import { DrivePad } from './drive_pad.js';
import { readGamepad } from './gamepad.js';
import { GaitSliders } from './gait_sliders.js';

/** Time between two signs of life (ms). */
const BEAT_INTERVAL = 60;
/** Least time between two velocities (ms). */
const VELOCITY_INTERVAL = 100;
/** Velocities that differ by less are the same, as shares of the largest. */
const RESOLUTION = 0.004;
/** Largest velocities that are asked for, of a robot of the paper's size: ahead, back, aside (m/s), turning (°/s). */
const LIMITS = { ahead: 1, back: 0.45, aside: 0.25, turn: 60 };
/** The share of them that a key asks for. */
const KEY_SHARE = 0.5;
const KEYS = {
  KeyW: [1, 0, 0], ArrowUp: [1, 0, 0], KeyS: [-1, 0, 0], ArrowDown: [-1, 0, 0], KeyA: [0, 1, 0], KeyD: [0, -1, 0],
  KeyQ: [0, 0, 1], ArrowLeft: [0, 0, 1], KeyE: [0, 0, -1], ArrowRight: [0, 0, -1],
};

const $ = (id) => document.getElementById(id);

export class Teleoperation {
  constructor(send) {
    this.send = send;
    this.drives = false;
    this.scale = 1;
    this.heldKeys = new Set();
    this.fast = false;
    this.stick = [0, 0, 0];
    // After a stop until the sticks are centred.
    this.stickIsIgnored = false;
    this.sent = { velocity: [0, 0, 0], at: 0 };
    this.pad = new DrivePad($('pad'), $('yaw'), () => this.#steer());
    this.sliders = new GaitSliders($('sliders'), (line) => this.command(line));
    this.#listen();
    setInterval(() => this.#beat(), BEAT_INTERVAL);
  }

  /** Which page drives has changed. */
  setDriver({ you, taken }) {
    this.drives = you;
    $('take-control').textContent = you ? 'Release control' : 'Take control';
    $('take-control').classList.toggle('mine', you);
    $('take-control').disabled = taken && !you;
    $('driver').textContent = you ? 'this page drives' : taken ? 'another page drives' : 'nobody drives';
    $('controls').hidden = !you;
    if (!you) this.#rest();
  }

  command(line) {
    if (this.drives) this.send({ command: line });
  }

  stop() {
    this.#rest();
    this.send('stop');
  }

  /** Shows the gait parameters in force. */
  showGait(gait) {
    this.sliders.show(gait);
  }

  /** Asks for nothing any more, and sends nothing. */
  #rest() {
    this.heldKeys.clear();
    this.pad.reset();
    this.sent.velocity = [0, 0, 0];
  }

  #beat() {
    if (!this.drives || document.hidden) return;
    this.#readGamepad();
    this.#steer();
    this.send('beat');
  }

  #readGamepad() {
    const gamepad = readGamepad();
    $('gamepad').textContent = gamepad ? '· gamepad: left stick walks, right stick turns, B stops' : '';
    const velocity = gamepad?.velocity ?? [0, 0, 0];
    if (gamepad?.stops) {
      if (!this.stickIsIgnored) this.stop();
      this.stickIsIgnored = true;
    } else if (velocity.every((value) => value === 0)) this.stickIsIgnored = false;
    this.stick = this.stickIsIgnored ? [0, 0, 0] : velocity;
  }

  /** The velocity that is asked for: ahead, left and turn, each within ±1. */
  #wanted() {
    const sum = this.pad.velocity.map((value, index) => value + this.stick[index]);
    this.heldKeys.forEach((code) => KEYS[code].forEach((value, index) => {
      sum[index] += value * (this.fast ? 1 : KEY_SHARE);
    }));
    return sum.map((value) => Math.max(-1, Math.min(1, value)));
  }

  /** Sends the velocity if it has changed. One that has become zero is sent at once: the robot stops. */
  #steer() {
    const wanted = this.#wanted();
    const changed = wanted.some((value, index) => Math.abs(value - this.sent.velocity[index]) > RESOLUTION);
    const isZero = wanted.every((value) => value === 0);
    const now = performance.now();
    if (!changed || (!isZero && now - this.sent.at < VELOCITY_INTERVAL)) return;
    this.sent = { velocity: wanted, at: now };
    const [ahead, left, turn] = wanted;
    const froude = Math.sqrt(this.scale);
    const rounded = (value) => Math.round(value * 1e3) / 1e3 + 0;
    this.command({
      vx: rounded(ahead * (ahead > 0 ? LIMITS.ahead : LIMITS.back) * froude),
      vy: rounded(left * LIMITS.aside * froude),
      wz_deg_s: rounded((turn * LIMITS.turn) / froude),
    });
  }

  #listen() {
    $('take-control').onclick = () => this.send({ drive: !this.drives });
    $('stop').onclick = () => this.stop();
    document.querySelectorAll('[data-intent]').forEach((button) => {
      button.onclick = () => this.command({ intent: button.dataset.intent });
    });
    addEventListener('keydown', (event) => {
      if (event.target.matches('select, input[type=text]') || event.ctrlKey || event.metaKey || event.altKey) return;
      this.fast = event.shiftKey;
      if (event.code === 'Space' || event.code === 'Escape') {
        event.preventDefault();
        this.stop();
      } else if (KEYS[event.code] && this.drives) {
        event.preventDefault();
        // A key that is still held after a stop must be pressed anew.
        if (event.repeat) return;
        this.heldKeys.add(event.code);
        this.#steer();
      }
    });
    addEventListener('keyup', (event) => {
      this.fast = event.shiftKey;
      if (this.heldKeys.delete(event.code)) this.#steer();
    });
    // A key that is released elsewhere is not seen.
    const away = () => {
      this.heldKeys.clear();
      this.pad.reset();
      if (this.drives) this.#steer();
    };
    addEventListener('blur', away);
    document.addEventListener('visibilitychange', away);
  }
}
