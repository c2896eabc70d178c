// Builds the page into dist: node build.mjs [FOLDER]. Needs the packages of package-lock.json.
//
// What comes out is committed, so that whoever has only Rust gets the page; .ci/studio compares.
import { copyFileSync, mkdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const folder = process.argv[2] ?? join(here, "dist");
mkdirSync(folder, { recursive: true });

const common = {
  absWorkingDir: here,
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  legalComments: "eof",
  charset: "utf8",
};

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

await build({
  ...common,
  entryPoints: [join(here, "src/main.js")],
  outfile: join(folder, "studio.js"),
  plugins: [workers],
});
// The 3D view is loaded when its tab is opened.
await build({
  ...common,
  entryPoints: [join(here, "src/view/index.js")],
  globalName: "filpostView",
  outfile: join(folder, "view.js"),
});
await build({
  ...common,
  entryPoints: [join(here, "src/studio.css")],
  outfile: join(folder, "studio.css"),
});
copyFileSync(join(here, "src/index.html"), join(folder, "index.html"));
