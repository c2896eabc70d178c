// The cases of the post: run in the page's own back end, made of what is shown.
import { baseOf, folderOf, isCl, isFil, joined } from "./files.js";
import { MACHINE } from "./posting.js";

/** Keys of a case.toml that a request to post takes as they are. */
const KEPT = ["set", "options", "levels", "strict", "allow", "clock", "fuel", "dialect", "raw_records", "units", "ready"];

/** Keys that name files, and those that say what must come or are for people. */
const FILES = ["cl", "machine", "option_file", "fil", "compat"];
const REST = ["simulate", "expect", "expect_error", "expect_warnings", "origin", "repairs", "tolerance", "ignore", "diameter"];

const plain = (text) => text.replaceAll("\r\n", "\n");

export class Cases {
  constructor(files, posting, ask) {
    this.files = files;
    this.posting = posting;
    this.ask = ask;
    /** The keys of the texts that were read. */
    this.read = new Map();
  }

  /** The case.toml files. */
  names() {
    return this.files.names().filter((name) => baseOf(name) === "case.toml");
  }

  /** The keys of a case. */
  async keys(name) {
    const text = await this.files.read(name);
    if (this.read.get(name)?.text !== text) {
      const { case: keys, why } = await this.ask({ do: "case", text });
      this.read.set(name, { text, keys, why });
    }
    const { keys, why } = this.read.get(name);
    if (!keys) throw new Error(why);
    return keys;
  }

  /** The case whose CL file this is: its name and its keys; null for none. */
  async ofPart(part) {
    for (const name of this.names().filter((each) => folderOf(each) === folderOf(part))) {
      const keys = await this.keys(name).catch(() => null);
      if (keys && joined(folderOf(name), keys.cl) === part) return { name, keys };
    }
    return null;
  }

  /** What the case of a part says of posting it; null where it has none. */
  async recipe(part) {
    const found = await this.ofPart(part);
    if (!found) return null;
    const { name, keys } = found;
    const fil = [keys.fil ?? []].flat().map((each) => joined(folderOf(name), each));
    await Promise.all(fil.filter((each) => this.files.has(each)).map((each) => this.files.read(each)));
    const kept = KEPT.filter((key) => key !== "ready" && keys[key] !== undefined);
    const compat = keys.compat ? joined(folderOf(name), keys.compat) : null;
    if (compat && this.files.has(compat)) await this.files.read(compat);
    return { name, simulate: keys.simulate, fil, compat, keys: Object.fromEntries(kept.map((key) => [key, keys[key]])) };
  }

  /** The program that a case must give; null where it has none. */
  async expected({ name, keys }) {
    const file = keys.expect && joined(folderOf(name), keys.expect);
    return file && this.files.has(file) ? { name: file, text: plain(await this.files.read(file)) } : null;
  }

  /** Runs a case: `{name, state, why, cl}`; `state` is passed, failed, or not run. */
  async run(name) {
    let keys, request;
    try {
      keys = await this.keys(name);
      request = await this.request(name, keys);
    } catch (error) {
      return { name, state: "failed", why: error.message };
    }
    const cl = joined(folderOf(name), keys.cl);
    const unknown = Object.keys(keys).filter((key) => ![...KEPT, ...FILES, ...REST].includes(key));
    if (unknown.length) {
      return { name, cl, state: "skipped", why: `${unknown.join(", ")}: run it with filpost test` };
    }
    const answer = await this.ask(request).catch((error) => ({ failure: error.message }));
    return { name, cl, ...(await this.judge(name, keys, request, answer)) };
  }

  async judge(name, keys, request, answer) {
    if (answer.failure || answer.misuse) return { state: "failed", why: answer.failure ?? answer.misuse };
    const code = answer.errors?.[0]?.code;
    if (keys.expect_error) {
      return code === keys.expect_error
        ? { state: "passed" }
        : { state: "failed", why: `it should be refused with ${keys.expect_error}${code ? `, not ${code}` : ", and there is a program"}` };
    }
    if (code) return { state: "failed", why: `${code}: ${answer.errors[0].message}` };
    const warned = new Set(answer.warnings.map((warning) => warning.code));
    const missing = (keys.expect_warnings ?? []).filter((each) => !warned.has(each));
    if (missing.length) return { state: "failed", why: `the warning ${missing[0]} does not come` };
    const expected = await this.expected({ name, keys });
    if (!expected) return keys.expect ? { state: "failed", why: `there is no ${keys.expect}` } : { state: "passed" };
    return this.compare(request, keys, answer.nc, expected.text);
  }

  /** Letter by letter, or as a control reads it if the case has a tolerance or ignores something. */
  async compare(request, keys, nc, expected) {
    if (plain(nc) === expected) return { state: "passed" };
    if (keys.tolerance !== undefined || keys.ignore?.length) {
      const { machine, ready, option_file: optionFile, set, options } = request;
      const { tolerance = 0, ignore, diameter } = keys;
      const answer = await this.ask({
        do: "compare", machine, ready, option_file: optionFile, set, options, nc, other: expected, tolerance, ignore, diameter,
      });
      const trouble = answer.misuse ?? answer.errors?.[0]?.message ?? answer.differences?.[0]?.message;
      return trouble ? { state: "failed", why: trouble } : { state: "passed" };
    }
    const lines = plain(nc).split("\n");
    const wanted = expected.split("\n");
    const at = lines.findIndex((line, index) => line !== wanted[index]);
    const line = at < 0 ? lines.length : at;
    return { state: "failed", why: `line ${line + 1}: ${wanted[line] ?? "(end)"} is expected, ${lines[line] ?? "(end)"} comes` };
  }

  async request(name, keys) {
    const folder = folderOf(name);
    const file = async (of) => {
      const known = joined(folder, of);
      return { name: known, text: await this.files.read(known) };
    };
    const cl = await file(keys.cl);
    const fil = Array.isArray(keys.fil) ? keys.fil : keys.fil ? [keys.fil] : [];
    const request = { do: "post", cl: cl.text, cl_name: cl.name, fil: await Promise.all(fil.map(file)) };
    for (const key of ["machine", "option_file", "compat"]) if (keys[key]) request[key] = await file(keys[key]);
    for (const key of KEPT) if (keys[key] !== undefined) request[key] = keys[key];
    const others = this.files.names().filter((each) => isFil(each) && this.files.text(each) !== null && !fil.some((of) => joined(folder, of) === each));
    request.includes = others.map((each) => ({ name: baseOf(each), text: this.files.text(each) }));
    return request;
  }

  /** What of the scripts all cases have run, `{name, lines, line_share, branch_share, never}` of each file. */
  async coverage() {
    const jobs = [];
    for (const name of this.names()) {
      const job = await this.keys(name).then((keys) => this.request(name, keys)).catch(() => null);
      if (job) jobs.push(job);
    }
    for (const job of jobs) delete job.do;
    const answer = await this.ask({ do: "cover", jobs });
    return answer.files ?? [];
  }

  /** Makes a case of the part and the program that are shown. */
  save(name) {
    const folder = `cases/${name}`;
    const { part, answer } = this.posting;
    const cl = isCl(baseOf(part)) ? baseOf(part) : "part.ncl";
    const up = (of) => JSON.stringify(`../../${of}`);
    const scripts = this.posting.scripts().fil.map((file) => up(file.name));
    const lines = [
      `cl = ${JSON.stringify(cl)}`,
      `machine = ${up(MACHINE)}`,
      ...(scripts.length ? [`fil = [${scripts.join(", ")}]`] : []),
      `expect = "expected.nc"`,
      `origin = "saved in the studio: what the post gave"`,
    ];
    this.files.set(`${folder}/case.toml`, `${lines.join("\n")}\n`);
    this.files.set(`${folder}/${cl}`, this.files.text(part));
    this.files.set(`${folder}/expected.nc`, answer.nc);
    return folder;
  }
}
