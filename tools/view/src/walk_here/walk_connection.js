// The way to a robot that walks in this browser: the same messages as over a socket to `halfstep view`.
import { threadOf } from './packed_module.js';

export class WalkConnection {
  /** `program` is the text of the thread, `module` the promise of the compiled module. */
  constructor(handlers, program, module) {
    this.handlers = handlers;
    this.thread = threadOf(program);
    this.thread.onmessage = ({ data }) => this.#hear(data);
    this.thread.onerror = ({ message }) => handlers.problem(`the walk ended by an error: ${message}`);
    this.ready = this.#start(module);
  }

  async #start(compiled) {
    const module = await compiled;
    const ready = new Promise((resolve) => { this.isReady = resolve; });
    this.thread.postMessage({ module });
    return ready;
  }

  #hear({ texts, ready, factor, walked }) {
    texts.forEach((text) => {
      const [[kind, content]] = Object.entries(JSON.parse(text));
      this.handlers[kind]?.(content);
    });
    if (ready) this.isReady();
    if (factor) this.handlers.factor(factor);
    if (walked) this.hasWalked?.(walked);
  }

  send(message) {
    this.thread.postMessage({ hear: message });
  }

  /** Begins a walk: `robot` is `{ in_the_box }` or `{ urdf }`. */
  begin(robot, seed) {
    this.thread.postMessage({ begin: { robot, seed } });
  }

  /** Simulated seconds per second; 0 halts the walk. */
  setPace(pace) {
    this.thread.postMessage({ pace });
  }

  /** Walks on by some periods as fast as it can: how many, and in how many seconds. */
  walk(ticks) {
    return new Promise((resolve) => {
      this.hasWalked = resolve;
      this.thread.postMessage({ walk: ticks });
    });
  }
}
