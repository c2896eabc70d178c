// Posts in a thread of its own, so that the page answers while a program is made.
import { load } from "../../../../../docs/playground/filpost.js";

let ask = null;

self.onmessage = async ({ data }) => {
  if (data.wasm) {
    // A text goes to the page much faster than what it says.
    ask = load(data.wasm, data.words, (text) => text);
    return;
  }
  const { number, request } = data;
  try {
    self.postMessage({ number, text: (await ask)(request) });
  } catch (error) {
    self.postMessage({ number, failure: String(error) });
  }
};
