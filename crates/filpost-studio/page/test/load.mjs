// Measures the page: node load.mjs PROGRAM|FOLDER CHROMIUM, with the program of the server or the folder of the playground.
//
// Prints the sizes of its files, as they are and compressed, and of ten loads in a fresh profile the middle and the
// longest time from the start of the navigation until the page says what the post gives (the playground), or until it
// can be used (the studio, whose folder is empty). Then it types into a CL file of 3 MB and into a script beside it, and
// prints how long after a key the block that it changes is on the page.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { createServer } from "node:http";
import { mkdtempSync, readdirSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, extname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { gzipSync } from "node:zlib";
import { chromium } from "playwright-core";
import { begin, openFile, shows, typeAtTop } from "./steps.mjs";

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

const KINDS = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm" };

/** The playground as a web server gives it: compressed. */
const packed = isPlayground && new Map(readdirSync(folder).map((name) => [`/${name}`, gzipSync(readFileSync(join(folder, name)))]));

async function hosted() {
  const server = createServer(({ url }, answer) => {
    if (!packed.has(url)) return answer.writeHead(404).end();
    answer.writeHead(200, { "Content-Type": KINDS[extname(url)], "Content-Encoding": "gzip", "Cache-Control": "no-store" });
    answer.end(packed.get(url));
  });
  await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
  return [`http://127.0.0.1:${server.address().port}/index.html`, () => server.close()];
}

/** The address of the page, and what ends it. */
async function serve() {
  if (isPlayground) return [pathToFileURL(resolve(program, "index.html")).href, () => {}];
  const server = spawn(program, ["--no-open", join(top, "post")], { stdio: ["ignore", "pipe", "ignore"] });
  const address = await new Promise((found) => server.stdout.once("data", (line) => found(String(line).trim())));
  return [address, () => server.kill(), server];
}

const middle = (times) => times.sort((a, b) => a - b)[Math.floor(times.length / 2)];

/** Loads the page some times, and says how long it took. */
async function load(from, serve) {
  const loads = [];
  for (let load = 0; load < LOADS; load++) loads.push(await once(serve));
  const [times, works] = [0, 1].map((at) => loads.map((each) => each[at]).sort((a, b) => a - b));
  console.log(`ready${from} after ${Math.round(times[0])} ms at best, ${Math.round(middle(times))} ms in the middle of ${LOADS} loads, ${Math.round(times.at(-1))} ms at most `
    + `(processor time of the page ${Math.round(works[0])} ms at best)`);
}

async function once(serve) {
  const [address, end] = await serve();
  const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
  const page = await browser.newPage();
  // A browser that has just been started is busy with pages of its own.
  await page.waitForTimeout(2000);
  const devtools = await browser.newBrowserCDPSession(), before = await ofPages(devtools);
  await page.goto(address);
  const ready = isPlayground ? "#status:text-matches('blocks of')" : "#dialog[open] .card";
  await page.locator(ready).first().waitFor();
  const time = await page.evaluate(() => performance.now());
  const work = await ofPages(devtools) - before;
  await browser.close();
  end();
  return [time, work];
}

/** The processor time of the pages of a browser, milliseconds. */
async function ofPages(devtools) {
  const { processInfo } = await devtools.send("SystemInfo.getProcessInfo");
  return processInfo.filter(({ type }) => type === "renderer").reduce((sum, { cpuTime }) => sum + cpuTime * 1000, 0);
}

await load(isPlayground ? " from a disk" : "", serve);
if (isPlayground) await load(" from a web server", hosted);
await type();
rmSync(top, { recursive: true, force: true });

/** Types into a large CL file and waits for each block. */
async function type() {
  const [address, end, server] = await serve();
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
  const size = `${(text.length / 1e6).toFixed(1)} MB of CL are posted anew`;
  console.log(`${size} ${await keysIn(page, "Z5.0", server)} in the CL file`);
  // A section of a script that writes a block with the digit.
  await openFile(page, "post.fil");
  await typeAtTop(page, "CIMFIL/ON,SPINDL\n  POSTN/OUT,S,1\n  DMY = POSTF(13)\nCIMFIL/OFF\n");
  await shows(page, "S1");
  await page.locator("#editors .editor:visible .cm-line", { hasText: "POSTN/OUT,S,1" }).click();
  await page.keyboard.press("End");
  console.log(`${size} ${await keysIn(page, "S1", server)} in a script`);
  await browser.close();
  end();
}

/** Types digits at the cursor, and says how long after each the block shows it behind `start`, and what the page and the server work for that. */
async function keysIn(page, start, server) {
  const devtools = await page.context().browser().newBrowserCDPSession();
  const spent = async () => [await ofPages(devtools), server ? processorTime(server) : 0];
  await page.evaluate((before) => {
    const content = document.querySelector("#nc .cm-content");
    let begun = 0, wanted = null;
    globalThis.typed = [];
    globalThis.onkeydown = ({ key }) => {
      if (/\d/.test(key)) [begun, wanted] = [performance.now(), `${before}${key}`];
    };
    // What is changed in the page is painted with the next picture.
    new MutationObserver(() => {
      if (!wanted || !content.textContent.includes(wanted)) return;
      wanted = null;
      requestAnimationFrame(() => setTimeout(() => globalThis.typed.push(performance.now() - begun)));
    }).observe(content, { childList: true, characterData: true, subtree: true });
  }, start);
  const works = [];
  for (let key = 1; key <= KEYS; key++) {
    const before = await spent();
    await page.keyboard.press(String(key));
    await page.waitForFunction((count) => globalThis.typed.length === count, key);
    const after = await spent();
    works.push(after.map((value, at) => value - before[at]));
    await page.waitForTimeout(1500);
    await page.keyboard.press("Backspace");
    await page.waitForTimeout(1500);
  }
  const [ofPage, ofServer] = [0, 1].map((at) => Math.round(middle(works.map((work) => work[at]))));
  const typed = await page.evaluate(() => globalThis.typed), [best] = typed.sort((a, b) => a - b);
  return `${Math.round(best)} ms after a key at best, ${Math.round(middle(typed))} ms in the middle of ${KEYS}, ${Math.round(typed.at(-1))} ms at most `
    + `(processor time of the page ${ofPage} ms${server ? `, of the server ${ofServer} ms` : ""})`;
}

/** The processor time of a process, milliseconds: Linux counts it in hundredths of a second. */
function processorTime({ pid }) {
  const fields = readFileSync(`/proc/${pid}/stat`, "utf8").split(") ")[1].split(" ");
  return (Number(fields[11]) + Number(fields[12])) * 10;
}
