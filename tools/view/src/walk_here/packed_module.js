// The WebAssembly module, which the page holds as a text in base 64 that is compressed by gzip.

export async function compiled(text) {
  const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  return WebAssembly.compile(await new Response(stream).arrayBuffer());
}

/** A thread that runs the program of a text. */
export function threadOf(program) {
  return new Worker(URL.createObjectURL(new Blob([program], { type: 'text/javascript' })));
}
