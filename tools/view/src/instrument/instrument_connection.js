// The way to the thread that computes: one question at a time. Of those that come meanwhile the newest is asked next.
import { threadOf } from '../walk_here/packed_module.js';

export class InstrumentConnection {
  /** `handlers` has `dials`, `answer` and `problem`; each gets what was told, and in how many seconds. */
  constructor(handlers, program, module) {
    this.handlers = handlers;
    this.next = null;
    this.isBusy = true;
    this.thread = threadOf(program);
    this.thread.onmessage = ({ data: { told, seconds } }) => this.#hear(told, seconds);
    this.thread.onerror = ({ message }) => handlers.problem(`the computation ended by an error: ${message}`);
    module.then((compiled) => this.thread.postMessage({ module: compiled }));
  }

  ask(question) {
    this.next = question;
    this.#go();
  }

  /** Whether the last answer is that to the last question. */
  get isSettled() {
    return !this.isBusy;
  }

  #hear(told, seconds) {
    this.isBusy = false;
    const [[kind, content]] = Object.entries(told);
    this.handlers[kind](content, seconds);
    this.#go();
  }

  #go() {
    if (this.isBusy || !this.next) return;
    this.isBusy = true;
    this.thread.postMessage({ ask: this.next });
    this.next = null;
  }
}
