// filpost.wasm behind one function: a request goes in, an answer comes out, both plain
// objects. The requests are those of crates/filpost-wasm.

/**
 * Loads the module. `wasm` are the bytes of filpost.wasm, or what was compiled of them. What comes back
 * answers requests one by one; a request that breaks the module (its stack or its memory is full) throws, and the
 * next one begins with a fresh module. `read` makes the answer of its JSON text. `progress` is told
 * how much of a CL text has been read, 0 to 1, while the module posts. The request `words`, which gives
 * the pages of the post words where editors are asked, is repeated to each fresh module.
 */
export async function load(wasm, read = JSON.parse, progress = () => {}) {
  const module = wasm instanceof WebAssembly.Module ? wasm : await WebAssembly.compile(wasm);
  let instance = null, words = null;

  function start() {
    instance = new WebAssembly.Instance(module, { filpost: { progress } });
    if (words) ask(words);
  }

  function ask(request) {
    if (!instance) start();
    if (request.do === "words") words = request;
    const { memory, filpost_request, filpost_answer, filpost_answered } = instance.exports;
    const text = new TextEncoder().encode(JSON.stringify(request));
    try {
      const at = filpost_request(text.length);
      new Uint8Array(memory.buffer, at, text.length).set(text);
      const length = filpost_answer();
      const answer = new Uint8Array(memory.buffer, filpost_answered(), length);
      return read(new TextDecoder().decode(answer));
    } catch (error) {
      instance = null;
      throw error;
    }
  }

  return ask;
}
