// Measures the page: node load.mjs PROGRAM|FOLDER CHROMIUM, with the program of the server or the folder of the playground.
//
// Prints the sizes of its files, as they are and compressed, and of ten loads in a fresh profile the middle and the
// longest time from the start of the navigation until the page says what the post gives (the playground), or until it
// can be used (the studio, whose folder is empty). Then it types into a CL file of 3 MB, and prints how long after a key
// the block that it changes is on the page.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { gzipSync } from "node:zlib";
import { chromium } from "playwright-core";
import { begin, openFile, shows } from "./steps.mjs";

const LOADS = 10;

/** Keys that are typed, and motions of the CL file: 3 MB. */
const KEYS = 9, MOTIONS = 92_000;

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

const middle = (times) => times.sort((a, b) => a - b)[Math.floor(times.length / 2)];

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
console.log(`ready after ${Math.round(middle(times))} ms in the middle of ${LOADS} loads, ${Math.round(times.at(-1))} ms at most`);
await type();
rmSync(top, { recursive: true, force: true });

/** Types into a large CL file and waits for each block. */
async function type() {
  const [address, end] = await serve();
  const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
  const page = await browser.newPage();
  await page.goto(address);
  await begin(page, "fanuc-mill");
  const lines = Array.from({ length: MOTIONS }, (_, at) => `GOTO / ${(at % 977 / 10).toFixed(4)}, ${(at % 1013 / 10).toFixed(4)}, -1.0000`);
  const text = `UNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\nFEDRAT / 300, MMPM\nGOTO / 5, 5, 5.0\n${lines.join("\n")}\nFINI\n`;
  assert.ok(text.length > 3_000_000);
  const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.click("#add")]);
  await chooser.setFiles({ name: "large.ncl", mimeType: "text/plain", buffer: Buffer.from(text) });
  await shows(page, "Z5.");
  await openFile(page, "large.ncl");
  await page.locator("#editors .editor:visible .cm-line", { hasText: "GOTO / 5, 5, 5.0" }).click();
  await page.keyboard.press("End");
  await page.evaluate(() => {
    globalThis.typed = [];
    document.addEventListener("keydown", ({ key }) => {
      const start = performance.now(), block = `Z5.0${key}`;
      const look = () => {
        if (!document.querySelector("#nc .cm-content").textContent.includes(block)) return requestAnimationFrame(look);
        globalThis.typed.push(performance.now() - start);
      };
      requestAnimationFrame(look);
    }, { capture: true });
  });
  for (let key = 1; key <= KEYS; key++) {
    await page.keyboard.press(String(key));
    await page.waitForFunction((count) => globalThis.typed.length === count, key);
    await page.waitForTimeout(1500);
    await page.evaluate(() => document.execCommand("delete"));
    await page.waitForTimeout(1500);
  }
  const typed = await page.evaluate(() => globalThis.typed);
  console.log(`${(text.length / 1e6).toFixed(1)} MB of CL are posted anew ${Math.round(middle(typed))} ms after a key in the middle of ${KEYS}, ${Math.round(typed.at(-1))} ms at most`);
  await browser.close();
  end();
}
