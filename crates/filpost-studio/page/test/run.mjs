// Uses the page as a person does: node run.mjs PROGRAM CHROMIUM [FOLDER FOR SCREENSHOTS].
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { tests } from "./studio.mjs";

const [program, executablePath, pictures] = process.argv.slice(2);
const args = [
  "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run",
  "--disable-background-networking", "--disable-component-update", "--disable-sync",
];
const browser = await chromium.launch({ executablePath, args });

/** What no page may do: throw, or ask for something that is not its own. */
const wrong = [];

/** A studio over a new folder, and its page. */
async function studio({ viewport = { width: 1280, height: 800 } } = {}) {
  const top = mkdtempSync(join(tmpdir(), "studio-"));
  const folder = join(top, "my-post");
  const server = spawn(program, ["--no-open", folder], { stdio: ["ignore", "pipe", "inherit"] });
  const address = await new Promise((resolve) => {
    server.stdout.once("data", (line) => resolve(String(line).trim()));
  });
  const ended = new Promise((resolve) => server.on("exit", resolve));
  const context = await browser.newContext({ viewport });
  const page = await context.newPage();
  page.on("pageerror", (error) => wrong.push(`the page threw ${error}`));
  page.on("console", (message) => {
    if (message.type() === "error") wrong.push(`the page said ${message.text()}`);
  });
  page.on("request", (request) => {
    const url = request.url();
    if (!url.startsWith(address) && !url.startsWith("data:") && !url.startsWith("blob:")) wrong.push(`the page asked for ${url}`);
  });
  await page.goto(address);
  return {
    page,
    address,
    folder,
    read: (name) => readFileSync(join(folder, name), "utf8"),
    async picture(name) {
      if (!pictures) return;
      mkdirSync(pictures, { recursive: true });
      await page.screenshot({ path: join(pictures, `${name}.png`) });
    },
    async close() {
      await context.close();
      assert.equal(await ended, 0, "the studio ends when its page is closed");
      rmSync(top, { recursive: true });
    },
  };
}

let failed = 0;
for (const [name, test] of Object.entries(tests)) {
  try {
    await test(studio);
    assert.deepEqual(wrong.splice(0), []);
    console.log(`ok      ${name}`);
  } catch (error) {
    failed += 1;
    wrong.splice(0);
    console.log(`FAILED  ${name}\n${error.stack}`);
  }
}
await browser.close();
console.log(`studio: ${Object.keys(tests).length - failed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
