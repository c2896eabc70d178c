// Measures the page: node load.mjs PROGRAM|FOLDER CHROMIUM, with the program of the server or the folder of the playground.
//
// Prints the sizes of its files, as they are and compressed, and of ten loads in a fresh profile the middle and the
// longest time from the start of the navigation until the page says what the post gives (the playground), or until it
// can be used (the studio, whose folder is empty).
import { spawn } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { gzipSync } from "node:zlib";
import { chromium } from "playwright-core";

const LOADS = 10;

const [program, executablePath] = process.argv.slice(2);
const isPlayground = statSync(program).isDirectory();
const folder = isPlayground ? program : join(dirname(fileURLToPath(import.meta.url)), "../dist");
for (const name of readdirSync(folder).sort()) {
  const bytes = readFileSync(join(folder, name));
  console.log(`${name}: ${bytes.length} bytes, ${gzipSync(bytes, { level: 9 }).length} compressed`);
}

const top = mkdtempSync(join(tmpdir(), "studio-load-"));

/** The address of the page, and what ends it. */
async function serve() {
  if (isPlayground) return [pathToFileURL(resolve(program, "index.html")).href, () => {}];
  const server = spawn(program, ["--no-open", join(top, "post")], { stdio: ["ignore", "pipe", "ignore"] });
  const address = await new Promise((found) => server.stdout.once("data", (line) => found(String(line).trim())));
  return [address, () => server.kill()];
}

const times = [];
for (let load = 0; load < LOADS; load++) {
  const [address, end] = await serve();
  const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
  const page = await browser.newPage();
  await page.goto(address);
  const ready = isPlayground ? "#status:text-matches('blocks of')" : "#dialog[open] .card";
  await page.locator(ready).first().waitFor();
  times.push(await page.evaluate(() => performance.now()));
  await browser.close();
  end();
}
rmSync(top, { recursive: true, force: true });
times.sort((a, b) => a - b);
console.log(`ready after ${Math.round(times[LOADS / 2])} ms in the middle of ${LOADS} loads, ${Math.round(times.at(-1))} ms at most`);
