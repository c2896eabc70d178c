// Posts in a thread of its own, so that the page answers while a program is made.
import { load } from "../../../../../docs/playground/filpost.js";
import { LONG, lineDifference } from "./texts.js";

let ask = null;

/** The request that is being answered. */
let asked = 0;

/** The program of the last answer that had a long one: the page has it too. */
let last = null;

/** An answer as it goes to the page: of a long program only what is different in it. */
function packed(text, request) {
  if (request.do !== "post" || text.length < LONG) return text;
  const answer = JSON.parse(text), { nc } = answer, other = last;
  if (!nc) return text;
  last = nc;
  if (other === null) return text;
  return JSON.stringify({ ...answer, nc: lineDifference(other, nc) });
}

self.onmessage = async ({ data }) => {
  if (data.wasm) {
    // A text goes to the page much faster than what it says.
    ask = load(data.wasm, (text) => text, (share) => self.postMessage({ number: asked, share }));
    return;
  }
  const { number, request } = data;
  try {
    const answer = await ask;
    asked = number;
    self.postMessage({ number, text: packed(answer(request), request) });
  } catch (error) {
    self.postMessage({ number, failure: String(error) });
  }
};
