// The way to a robot that walks in this browser: the same messages as over a socket to `halfstep view`.

/** Bytes of a text in base 64 that is compressed by gzip. */
async function unpacked(text) {
  const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).arrayBuffer();
}

export class WalkConnection {
  /** `program` is the text of the thread, `walker` the packed module. */
  constructor(handlers, program, walker) {
    this.handlers = handlers;
    const address = URL.createObjectURL(new Blob([program], { type: 'text/javascript' }));
    this.thread = new Worker(address);
    this.thread.onmessage = ({ data }) => this.#hear(data);
    this.thread.onerror = ({ message }) => handlers.problem(`the walk ended by an error: ${message}`);
    this.ready = this.#start(walker);
  }

  async #start(walker) {
    const module = await WebAssembly.compile(await unpacked(walker));
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
