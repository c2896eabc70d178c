// Uses the page as a person does: node run.mjs PROGRAM CHROMIUM [FOLDER FOR SCREENSHOTS], with the program of the
// server, or with the folder of the playground: the same tests over both back ends. FILPOST_STUDIO_TEST runs those
// whose name has that text.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";
import { drawing } from "./drawing.mjs";
import { behaving } from "./page.mjs";
import { running } from "./running.mjs";
import { making } from "./studio.mjs";

const [program, executablePath, pictures] = process.argv.slice(2);
const args = [
  "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run",
  "--disable-background-networking", "--disable-component-update", "--disable-sync",
];
const browser = await chromium.launch({ executablePath, args });

/** What no page may do: throw, or ask for something that is not its own. */
const wrong = [];

const isPlayground = statSync(program).isDirectory();

/** A page that is watched. */
async function open(context, address, own) {
  const page = await context.newPage();
  page.on("pageerror", (error) => wrong.push(`the page threw ${error}`));
  page.on("console", (message) => {
    if (message.type() === "error") wrong.push(`the page said ${message.text()}`);
  });
  page.on("request", (request) => {
    const url = request.url();
    if (![own, "data:", "blob:"].some((start) => url.startsWith(start))) wrong.push(`the page asked for ${url}`);
  });
  await page.goto(address);
  return page;
}

async function picture(page, name) {
  if (!pictures) return;
  mkdirSync(pictures, { recursive: true });
  await page.screenshot({ path: join(pictures, `${name}.png`) });
}

/** A studio over a new folder, and its page. */
async function served(viewport) {
  const top = mkdtempSync(join(tmpdir(), "studio-"));
  const folder = join(top, "my-post");
  const server = spawn(program, ["--no-open", folder], { stdio: ["ignore", "pipe", "ignore"] });
  const address = await new Promise((found) => {
    server.stdout.once("data", (line) => found(String(line).trim()));
  });
  const ended = new Promise((over) => server.on("exit", over));
  const context = await browser.newContext({ viewport });
  return {
    page: await open(context, address, address),
    read: async (name) => readFileSync(join(folder, name), "utf8"),
    async close() {
      await context.close();
      assert.equal(await ended, 0, "the studio ends when its page is closed");
      rmSync(top, { recursive: true });
    },
  };
}

/** The playground from a disk, without a network, and with no post yet. */
async function unserved(viewport, hash = "") {
  const address = pathToFileURL(resolve(program, "index.html")).href;
  const context = await browser.newContext({ viewport, acceptDownloads: true });
  await context.setOffline(true);
  const page = await open(context, `${address}${hash}`, pathToFileURL(resolve(program)).href);
  return {
    page,
    context,
    address,
    read: (name) => page.evaluate((wanted) => globalThis.filpost.text(wanted), name),
    close: () => context.close(),
  };
}

/** A page with nothing in it yet; `hash` is the part of the address behind #, of the playground alone. */
async function studio({ viewport = { width: 1280, height: 800 }, hash } = {}) {
  const made = isPlayground ? await unserved(viewport, hash) : await served(viewport);
  return { ...made, picture: (name) => picture(made.page, name) };
}

const tests = { ...making, ...running, ...drawing, ...behaving };
let failed = 0;
const known = isPlayground ? { ...(await import("./alone.mjs")).alone, ...tests } : tests;
const wanted = process.env.FILPOST_STUDIO_TEST ?? "";
const all = Object.fromEntries(Object.entries(known).filter(([name]) => name.includes(wanted)));
for (const [name, test] of Object.entries(all)) {
  try {
    await test(studio, isPlayground);
    assert.deepEqual(wrong.splice(0), []);
    console.log(`ok      ${name}`);
  } catch (error) {
    failed += 1;
    wrong.splice(0);
    console.log(`FAILED  ${name}\n${error.stack}`);
  }
}
await browser.close();
console.log(`studio: ${Object.keys(all).length - failed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
