// Builds the playground: node build.mjs MODULES FOLDER, where .ci/wasm has left the modules. Needs
// the packages of the page of the studio (crates/filpost-studio/page).
//
// What comes out is one folder of static files: the page of the studio, the modules, and what is shown at first. The
// page opens from a server, which gives the modules as they are, or from a disk, where nothing can be fetched: there the
// modules are scripts, and so are the examples and the pages of the post words in both.
import { copyFileSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { examples } from "./examples.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const [modules, folder] = process.argv.slice(2);
const page = join(here, "../../crates/filpost-studio/page/dist");

mkdirSync(folder, { recursive: true });
for (const name of ["studio.js", "studio.css", "view.js"]) copyFileSync(join(page, name), join(folder, name));
const own = '<script src="studio.js"></script>';
const html = readFileSync(join(page, "index.html"), "utf8");
if (!html.includes(own)) throw new Error("the page of the studio has another script");
writeFileSync(join(folder, "index.html"), html.replace(own, `<script src="examples.js"></script>\n${own}`));

for (const name of ["filpost.wasm", "filpost-plot.wasm"]) {
  copyFileSync(join(modules, name), join(folder, name));
  const letters = readFileSync(join(modules, name)).toString("base64");
  writeFileSync(join(folder, `${name}.js`), `(globalThis.filpost ??= {})["${name}"] = "${letters}";\n`);
}

const list = examples(join(here, "../../corpus"));
const shown = list.map(({ expected, ...example }) => example);
const text = JSON.stringify(shown).replaceAll("<", "\\u003c");
writeFileSync(join(folder, "examples.js"), `(globalThis.filpost ??= {}).examples = ${text};\n`);
const words = JSON.stringify(readFileSync(join(here, "../../crates/filpost/data/words.md"), "utf8"));
writeFileSync(join(folder, "words.js"), `(globalThis.filpost ??= {}).words = ${words};\n`);
console.log(`${basename(folder)}: ${list.length} examples`);
