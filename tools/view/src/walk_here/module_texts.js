// Texts from and to a WebAssembly module: the page writes one into its memory, and reads what the module says.

const encoder = new TextEncoder();
const decoder = new TextDecoder();

export class ModuleTexts {
  constructor(exports) {
    this.exports = exports;
  }

  /** Writes a text to where the next function of the module reads it. */
  give(text) {
    const bytes = encoder.encode(text);
    const at = this.exports.halfstep_input(bytes.length);
    new Uint8Array(this.exports.memory.buffer, at, bytes.length).set(bytes);
  }

  /** What the module said last, one JSON text each. */
  said() {
    const at = this.exports.halfstep_output();
    const text = decoder.decode(new Uint8Array(this.exports.memory.buffer, at, this.exports.halfstep_output_length()));
    return text ? text.split('\n') : [];
  }
}
