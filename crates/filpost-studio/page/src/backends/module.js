// The module in the browser: files in memory, answers by WebAssembly in a worker.
import workerText from "worker:./worker.js";

/** Longest time a request may take, in milliseconds. */
const PATIENCE = 20_000;

/** What the second module answers; the first has all else. */
const JUDGED = new Set([
  "plot", "columns", "verify", "audit", "compare", "motions", "simulate", "debug", "cover",
  "outline", "definition", "references", "rename", "signature", "format", "beside",
]);

/** One module in a worker: requests, and a new worker where one takes too long. */
class Asked {
  constructor(wasm, words) {
    this.wasm = wasm;
    this.words = words;
    this.waiting = new Map();
    this.number = 0;
    /** What was asked last so that it can be stopped. */
    this.last = Promise.resolve();
    this.start();
  }

  start() {
    // From a text, so that the page also works where it was opened from a disk.
    const address = URL.createObjectURL(new Blob([workerText], { type: "text/javascript" }));
    this.worker = new Worker(address);
    this.worker.onmessage = ({ data }) => this.settle(data);
    this.worker.postMessage({ wasm: this.wasm, words: this.words });
  }

  settle({ number, text, failure, share }) {
    const waiting = this.waiting.get(number);
    if (!waiting) return;
    if (share !== undefined) return waiting.told(share);
    this.waiting.delete(number);
    clearTimeout(waiting.timer);
    if (failure) waiting.reject(new Error(failure));
    else waiting.resolve(JSON.parse(text));
  }

  /** Asks; a patient request waits until it is answered, or somebody stops it. `told` hears how much of it is done, 0 to 1. */
  ask(request, isPatient = false, told = () => {}) {
    const number = ++this.number;
    return new Promise((resolve, reject) => {
      this.waiting.set(number, { request, isPatient, told, resolve, reject });
      this.send(number);
    });
  }

  send(number) {
    this.time(number);
    this.worker.postMessage({ number, request: this.waiting.get(number).request });
  }

  /** Gives up what takes too long. Requests are answered one after the other: the first is it, unless it may take its time. */
  time(number) {
    const waiting = this.waiting.get(number);
    if (waiting.isPatient) return;
    waiting.timer = setTimeout(() => {
      const [first, { isPatient }] = this.waiting.entries().next().value;
      if (isPatient) this.time(number);
      else this.giveUp(first, `it took longer than ${PATIENCE / 1000} s and was stopped`);
    }, PATIENCE);
  }

  /** Ends a request; a new worker answers the others. */
  giveUp(number, failure) {
    this.worker.terminate();
    this.settle({ number, failure });
    this.start();
    for (const [other, { timer }] of this.waiting) {
      clearTimeout(timer);
      this.send(other);
    }
  }

  /** Asks so that it can be stopped. Begun is one after the other: what is superseded before is never asked. */
  askStoppable(request, told, isPatient) {
    let number = null, isOver = false;
    const answer = this.last.then(() => {
      if (isOver) throw new Error("it was stopped");
      const asked = this.ask(request, isPatient, told);
      number = this.number;
      return asked;
    });
    this.last = answer.catch(() => null);
    return {
      answer,
      supersede: () => (isOver = true),
      stop: () => {
        isOver = true;
        if (this.waiting.has(number)) this.giveUp(number, "it was stopped");
      },
    };
  }
}

function loadScript(name) {
  return new Promise((resolve, reject) => {
    const script = document.createElement("script");
    script.onload = resolve;
    script.onerror = () => reject(new Error(`${name} can't be loaded`));
    script.src = name;
    document.head.append(script);
  });
}

/** The back end of the page without a server; `parts` are the scripts beside it. */
export function moduleBackend(parts) {
  const first = new Asked(parts.bytes(), parts.words);
  let second = null;
  const judge = () => {
    second ??= loadScript("filpost-plot.wasm.js").then(() => new Asked(parts.plotBytes())).catch((error) => {
      second = null;
      throw error;
    });
    return second;
  };
  const ask = async (request) => {
    return JUDGED.has(request.do) ? (await judge()).ask(request) : first.ask(request);
  };
  const kept = new Map();
  let stamps = 0;
  return {
    keeps: false,
    ask,
    /** The module is stopped with its worker, and so only where somebody asks for that. */
    watched: (request, told, isPatient) => first.askStoppable(request, told, isPatient),
    list: async () => ({
      folder: "playground", all: true,
      files: [...kept].map(([name, { text, stamp }]) => ({ name, size: text.length, stamp })),
    }),
    read: async (name) => ({ ...kept.get(name), encoding: "UTF-8" }),
    write: async (name, text) => {
      const stamp = String(++stamps);
      kept.set(name, { text, stamp });
      return { stamp };
    },
    remove: async (name) => {
      kept.delete(name);
      return {};
    },
    /** Takes files as if they had been there. */
    put: (files) => {
      kept.clear();
      for (const { name, text } of files) kept.set(name, { text, stamp: String(++stamps) });
    },
  };
}
