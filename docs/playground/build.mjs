// Builds the page: node build.mjs MODULES FOLDER, where .ci/wasm has left the modules. Needs
// the packages of package.json.
//
// What comes out is one folder of static files. The page opens from a server or from a
// disk, so nothing is fetched: the modules and the examples are scripts.
import { copyFileSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";
import { examples } from "./examples.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const [modules, folder] = process.argv.slice(2);

const common = { bundle: true, minify: true, format: "iife", target: "es2022", legalComments: "eof" };

/** `worker:FILE` is the text of a script with all that it imports. */
const workers = {
  name: "workers",
  setup(host) {
    host.onResolve({ filter: /^worker:/ }, ({ path, resolveDir }) => {
      return { path: join(resolveDir, path.slice("worker:".length)), namespace: "worker" };
    });
    host.onLoad({ filter: /.*/, namespace: "worker" }, async ({ path }) => {
      const made = await build({ ...common, entryPoints: [path], write: false });
      return { contents: made.outputFiles[0].text, loader: "text" };
    });
  },
};

mkdirSync(folder, { recursive: true });
await build({
  ...common,
  entryPoints: [join(here, "playground.js")],
  outfile: join(folder, "playground.js"),
  plugins: [workers],
  nodePaths: (process.env.NODE_PATH ?? "").split(":").filter(Boolean),
});
for (const name of ["index.html", "page.css"]) copyFileSync(join(here, name), join(folder, name));

for (const [name, key] of [["filpost", "bytes"], ["filpost-plot", "plotBytes"]]) {
  const letters = readFileSync(join(modules, `${name}.wasm`)).toString("base64");
  const bytes = `() => Uint8Array.from(atob("${letters}"), (letter) => letter.charCodeAt(0))`;
  const script = `(globalThis.filpost ??= {}).${key} = ${bytes};\n`;
  writeFileSync(join(folder, `${name}.wasm.js`), script);
}

const list = examples(join(here, "../../corpus"));
const shown = list.map(({ expected, ...example }) => example);
const text = JSON.stringify(shown).replaceAll("<", "\\u003c");
writeFileSync(join(folder, "examples.js"), `(globalThis.filpost ??= {}).examples = ${text};\n`);
const words = JSON.stringify(readFileSync(join(here, "../../crates/filpost/data/words.md"), "utf8"));
writeFileSync(join(folder, "words.js"), `(globalThis.filpost ??= {}).words = ${words};\n`);
console.log(`${basename(folder)}: ${list.length} examples`);
