// Cases of the corpus as examples of the page: the tutorial and the published systems.
import { existsSync, readFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { parse, stringify } from "smol-toml";

/** Case folders and what the page calls them. */
const CASES = [
  ["tutorial", "Tutorial: a plate"],
  ["papers/embos-grooves", "Engraved grooves on a cylinder (Ts. Kaldashev)"],
  ["papers/thread-g76-cylindrical", "Thread by G76 (Ts. Kaldashev)"],
  ["papers/thread-g92-3-starts", "Thread of three starts by G92 (Ts. Kaldashev)"],
  ["papers/deep-thread-worm", "Deep thread: a worm (Ts. Kaldashev)"],
  ["papers/screw-trapezoid", "Screw with a trapezoidal groove (Ts. Kaldashev)"],
  ["papers/run-out-skew", "Run-out of a clamped cylinder (Ts. Kaldashev)"],
  ["papers/feed-control-look-ahead", "Feed control that looks ahead (Ts. Kaldashev)"],
  ["lib/tool-list/three-changes", "A list of tools at the start"],
  ["lib/helical-bore/two-holes", "Helical boring"],
  ["posts/heidenhain-5x/faces", "Five axes in Klartext"],
  ["posts/sinumerik-5x/tilted", "Tilted faces of a SINUMERIK"],
  ["errors/E0113-endif-without-if", "A script that is refused"],
];

/** Keys of case.toml that a request takes as they are. */
const KEPT = ["set", "allow", "strict", "dialect", "raw_records", "units", "clock", "fuel"];

/** The examples, as states of the page. */
export function examples(corpus) {
  return CASES.map(([name, title]) => example(join(corpus, name), title));
}

function example(folder, title) {
  const text = (name) => readFileSync(join(folder, name), "utf8");
  const file = (name) => ({ name: basename(name), text: text(name) });
  const found = parse(text("case.toml"));
  for (const key of ["option_file", "read", "compat"]) {
    if (found[key] !== undefined) throw new Error(`${folder}: the page has no ${key}`);
  }
  const machine = found.machine
    ? { name: "machine.toml", text: text(found.machine) }
    : { name: "machine.toml", text: `base = "${found.ready ?? "fanuc-mill"}"\n` };
  const kept = KEPT.filter((key) => found[key] !== undefined);
  const fil = [found.fil ?? []].flat();
  const includes = fil.flatMap((name) => included(join(folder, name)));
  const expected = found.expect && existsSync(join(folder, found.expect)) ? text(found.expect) : null;
  const own = {
    cl: basename(found.cl), machine: "machine.toml", fil: fil.map((name) => basename(name)),
    ...(expected === null ? {} : { expect: "expected.nc" }),
    ...Object.fromEntries(kept.map((key) => [key, found[key]])),
    origin: found.origin,
  };
  const files = [
    machine, file(found.cl), ...fil.map(file), ...includes,
    { name: "case.toml", text: stringify(own) },
    ...(expected === null ? [] : [{ name: "expected.nc", text: expected }]),
  ];
  return { title, files, part: basename(found.cl), open: own.fil[0] ?? basename(found.cl), expected };
}

/** What a script includes, by the names that it says. */
function included(path) {
  const names = readFileSync(path, "utf8").matchAll(/^\s*INCLUD\s*\/\s*(\S+)/gim);
  return [...names].map(([, name]) => {
    return { name, text: readFileSync(join(dirname(path), name), "utf8") };
  });
}
