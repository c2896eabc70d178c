// The module in the browser: files in memory, answers by WebAssembly in a worker.
import workerText from "worker:./worker.js";
import { LONG, whole } from "./texts.js";

/** Longest time a request may take, in milliseconds. */
const PATIENCE = 20_000;

/** What the second module answers; the first has all else. */
const JUDGED = new Set([
  "plot", "columns", "verify", "behind", "audit", "compare", "motions", "simulate", "debug", "cover",
  "outline", "definition", "references", "rename", "signature", "format", "beside",
]);

/** What shows pages of post words, which the module gets then. */
const WORDED = new Set(["hover", "complete", "signature"]);

/** One module in a worker: requests, and a new worker where one takes too long. */
class Asked {
  constructor(wasm) {
    this.wasm = wasm;
    /** The request that gives the pages of the post words. */
    this.words = null;
    this.waiting = new Map();
    this.number = 0;
    /** The last long program: the worker has it too. */
    this.program = null;
    /** What was asked last so that it can be stopped. */
    this.last = Promise.resolve();
    this.start();
  }

  start() {
    // From a text, so that the page also works where it was opened from a disk.
    const address = URL.createObjectURL(new Blob([workerText], { type: "text/javascript" }));
    this.worker = new Worker(address);
    this.worker.onmessage = ({ data }) => this.settle(data);
    this.worker.postMessage({ wasm: this.wasm });
    if (this.words) this.worker.postMessage({ number: 0, request: this.words });
  }

  /** Gives the pages of the post words, before what shows them. */
  give(pages) {
    this.words = { do: "words", pages };
    return this.ask(this.words);
  }

  settle({ number, text, failure, share }) {
    const waiting = this.waiting.get(number);
    if (!waiting) return;
    if (share !== undefined) return waiting.told(share);
    this.waiting.delete(number);
    clearTimeout(waiting.timer);
    if (failure) waiting.reject(new Error(failure));
    else waiting.resolve(this.unpack(JSON.parse(text), text.length, waiting.request));
  }

  /** An answer with its program, of which the worker says only what is different in it. */
  unpack(answer, length, request) {
    if (request.do !== "post" || !answer.nc) return answer;
    if (typeof answer.nc === "object") whole(answer, this.program);
    else if (length < LONG) return answer;
    this.program = answer.nc;
    return answer;
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

/** A module, compiled while it comes. From a disk it comes as a script, which has it as a text. */
async function compile(name, parts) {
  let address = name;
  if (location.protocol === "file:") {
    await loadScript(`${name}.js`);
    address = `data:application/wasm;base64,${parts[name]}`;
    delete parts[name];
  }
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`${name} can't be loaded`);
  // A server that does not know the kind of the file has to be read to its end first.
  const isKnown = answer.headers.get("Content-Type") === "application/wasm";
  return isKnown ? WebAssembly.compileStreaming(answer) : WebAssembly.compile(await answer.arrayBuffer());
}

/** What is made when it is asked for first, and again where that failed. */
function once(make) {
  let made = null;
  return () => (made ??= make().catch((error) => {
    made = null;
    throw error;
  }));
}

/** The back end of the page without a server; `parts` are the scripts beside it. */
export function moduleBackend(parts) {
  const asked = (name) => once(async () => new Asked(await compile(name, parts)));
  const post = asked("filpost.wasm"), judge = asked("filpost-plot.wasm");
  const tell = once(async () => {
    await loadScript("words.js");
    await (await post()).give(parts.words);
  });
  // It is needed at once.
  post().catch(() => null);
  const ask = async (request) => {
    if (WORDED.has(request.do)) await tell();
    return (await (JUDGED.has(request.do) ? judge : post)()).ask(request);
  };
  const kept = new Map();
  let stamps = 0;
  return {
    keeps: false,
    ask,
    /** The module is stopped with its worker, and so only where somebody asks for that. */
    watched: (request, told, isPatient) => {
      let isOver = false, work = null;
      const answer = post().then((first) => {
        if (isOver) throw new Error("it was stopped");
        work = first.askStoppable(request, told, isPatient);
        return work.answer;
      });
      const end = (how) => () => {
        isOver = true;
        work?.[how]();
      };
      return { answer, supersede: end("supersede"), stop: end("stop") };
    },
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
