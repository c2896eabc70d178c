// Requests to the worker, and a new worker where one takes too long.
import workerText from "worker:./worker.js";

/** Longest time a request may take, in milliseconds. */
const PATIENCE = 20_000;

export class Backend {
  /** The module, and the pages of the post words where its editors are asked. */
  constructor(wasm, words) {
    this.wasm = wasm;
    this.words = words;
    this.waiting = new Map();
    this.number = 0;
    this.start();
  }

  start() {
    // From a text, so that the page also works where it was opened from a disk.
    const address = URL.createObjectURL(new Blob([workerText], { type: "text/javascript" }));
    this.worker = new Worker(address);
    this.worker.onmessage = ({ data }) => this.settle(data);
    this.worker.postMessage({ wasm: this.wasm, words: this.words });
  }

  settle({ number, answer, failure }) {
    const waiting = this.waiting.get(number);
    if (!waiting) return;
    this.waiting.delete(number);
    clearTimeout(waiting.timer);
    if (failure) waiting.reject(new Error(failure));
    else waiting.resolve(answer);
  }

  /** The answer to a request of crates/filpost-wasm. */
  ask(request) {
    const number = ++this.number;
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => this.giveUp(), PATIENCE);
      this.waiting.set(number, { resolve, reject, timer });
      this.worker.postMessage({ number, request });
    });
  }

  giveUp() {
    this.worker.terminate();
    const failure = `it took longer than ${PATIENCE / 1000} s and was stopped`;
    for (const number of [...this.waiting.keys()]) this.settle({ number, failure });
    this.start();
  }
}
