// filpost.wasm behind one function: a request goes in, an answer comes out, both plain
// objects. The requests are those of crates/filpost-wasm.

/**
 * Loads the module. `bytes` are those of filpost.wasm, `words` the pages of the post words,
 * where its editors are asked. What comes back answers requests one
 * by one; a request that breaks the module (its stack or its memory is full) throws, and the
 * next one begins with a fresh module. `read` makes the answer of its JSON text. `progress` is told
 * how much of a CL text has been read, 0 to 1, while the module posts.
 */
export async function load(bytes, words, read = JSON.parse, progress = () => {}) {
  const module = await WebAssembly.compile(bytes);
  let instance = null;

  function start() {
    instance = new WebAssembly.Instance(module, { filpost: { progress } });
    if (words) ask({ do: "words", pages: words });
  }

  function ask(request) {
    if (!instance) start();
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
