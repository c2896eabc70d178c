// Posts in a thread of its own, so that the page answers while a program is made.
import { load } from "../../../../../docs/playground/filpost.js";

let ask = null;

/** The request that is being answered. */
let asked = 0;

self.onmessage = async ({ data }) => {
  if (data.wasm) {
    // A text goes to the page much faster than what it says.
    ask = load(data.wasm, data.words, (text) => text, (share) => self.postMessage({ number: asked, share }));
    return;
  }
  const { number, request } = data;
  try {
    const answer = await ask;
    asked = number;
    self.postMessage({ number, text: answer(request) });
  } catch (error) {
    self.postMessage({ number, failure: String(error) });
  }
};
