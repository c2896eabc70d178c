// Uses the page as a person does: node test.mjs FOLDER CHROMIUM [FOLDER FOR SCREENSHOTS].
import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium } from "playwright-core";
import { examples } from "./examples.mjs";
import { pack } from "./share.js";

const [folder, executablePath, pictures] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const address = pathToFileURL(resolve(folder, "index.html")).href;
const wanted = examples(join(here, "../../corpus"));

const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
const context = await browser.newContext({ viewport: { width: 1400, height: 900 } });
// Without a network: the folder must be all that the page needs.
await context.setOffline(true);

/** What no page may do: throw, or ask for something outside of its folder. */
const wrong = [];

async function open(link) {
  const page = await context.newPage();
  page.on("pageerror", (error) => wrong.push(`the page threw ${error}`));
  page.on("request", (request) => {
    const { protocol } = new URL(request.url());
    if (!["file:", "blob:", "data:", "about:"].includes(protocol)) wrong.push(request.url());
  });
  await page.goto(link);
  return page;
}

const program = (page) => page.evaluate(() => globalThis.filpost.program());
const said = (page, text) => page.locator("#status", { hasText: text }).waitFor({ timeout: 30_000 });

async function picture(page, name) {
  if (!pictures) return;
  mkdirSync(pictures, { recursive: true });
  await page.screenshot({ path: join(pictures, `${name}.png`) });
}

const tests = {
  async "every example gives the program of its case"() {
    const page = await open(address);
    for (const [index, { title, expected }] of wanted.entries()) {
      if (index > 0) {
        await said(page, /blocks|Refused/);
        await page.evaluate(() => (document.getElementById("status").textContent = ""));
        await page.selectOption("#examples", String(index));
      }
      if (expected === null) {
        await said(page, "Refused");
        assert.equal(await program(page), "", title);
        await picture(page, "refused");
      } else {
        await said(page, "blocks");
        // An editor has one kind of line end.
        assert.equal(await program(page), expected.replaceAll("\r\n", "\n"), title);
      }
    }
    await page.close();
  },

  async "a wrong line is marked, and no program is left"() {
    const page = await open(address);
    await said(page, "blocks");
    const editor = page.locator("#editors > div:not([hidden]) .cm-content");
    await editor.click();
    await page.keyboard.press("Control+Home");
    await page.keyboard.insertText("XX=SQRTF(\n");
    await said(page, "Refused");
    await page.locator(".cm-lintRange-error").first().waitFor();
    assert.equal(await program(page), "");
    assert.match(await page.locator("#findings").innerText(), /E\d{4} mill\.fil:1/);
    await picture(page, "wrong-line");
    await page.keyboard.press("Control+z");
    await said(page, "blocks");
    assert.equal(await program(page), wanted[0].expected);
    await page.close();
  },

  async "a block tells its CL line and its FIL lines"() {
    const page = await open(address);
    await said(page, "blocks");
    const lines = page.locator("#nc .cm-line");
    const count = await lines.count();
    let told = "";
    for (let at = 0; at < count && !told.includes("mill.fil:"); at++) {
      await lines.nth(at).hover({ position: { x: 20, y: 5 } });
      const tip = page.locator("#nc .cm-tooltip .hover");
      await tip.waitFor({ timeout: 5_000 });
      told = await tip.innerText();
      if (told.includes("mill.fil:")) await picture(page, "origin");
      await page.mouse.move(5, 5);
      await tip.waitFor({ state: "detached" });
    }
    assert.match(told, /plate\.ncl:\d+ {2}\S/);
    assert.match(told, /mill\.fil:\d+ {2}\S/);
    assert.ok((await page.locator(".marked").count()) > 0, "no line is marked");
    await page.close();
  },

  async "a word of FIL tells what it is, and proposals come"() {
    const page = await open(address);
    await said(page, "blocks");
    const editor = page.locator("#editors > div:not([hidden])");
    await editor.locator(".cm-line", { hasText: "CIMFIL" }).first().hover({ position: { x: 20, y: 5 } });
    const tip = page.locator(".cm-tooltip .hover");
    await tip.waitFor({ timeout: 10_000 });
    assert.ok((await tip.innerText()).length > 20);
    await page.mouse.move(5, 5);
    await tip.waitFor({ state: "detached" });
    await editor.locator(".cm-content").click();
    await page.keyboard.press("Control+Home");
    await page.keyboard.type("XX=SQR");
    await page.locator(".cm-tooltip-autocomplete", { hasText: "SQRTF" }).waitFor({ timeout: 10_000 });
    await picture(page, "proposals");
    await page.close();
  },

  async "a post word tells its forms and what is written"() {
    const page = await open(address);
    await said(page, "blocks");
    const editor = page.locator("#editors > div:not([hidden])");
    await editor.locator(".cm-content").click();
    await page.keyboard.press("Control+Home");
    await page.keyboard.type("SPINDL/OFF");
    await page.keyboard.press("Escape");
    await page.mouse.move(5, 5);
    await editor.locator(".cm-line").first().hover({ position: { x: 20, y: 5 } });
    const tip = page.locator(".cm-tooltip .hover");
    await tip.waitFor({ timeout: 10_000 });
    assert.match(await tip.innerText(), /SPINDL\/RPM/);
    await page.close();
  },

  async "the plot draws the program"() {
    const page = await open(address);
    await said(page, "blocks");
    await page.click("#show-plot");
    const drawn = page.frameLocator("#plot iframe").locator("canvas, svg").first();
    await drawn.waitFor({ timeout: 10_000 });
    const box = await drawn.boundingBox();
    assert.ok(box.width > 200 && box.height > 200, JSON.stringify(box));
    await page.waitForTimeout(500);
    await picture(page, "plot");
    await page.close();
  },

  async "a link brings all texts along"() {
    const page = await open(address);
    await said(page, "blocks");
    await page.locator("#tabs button", { hasText: "plate.ncl" }).click();
    await page.locator("#editors > div:not([hidden]) .cm-content").click();
    await page.keyboard.press("Control+Home");
    await page.keyboard.insertText("$$ a line of ours\n");
    await said(page, "blocks");
    await page.click("#share");
    await page.waitForFunction(() => location.hash.length > 100);
    const link = page.url();
    const other = await open(link);
    await said(other, "blocks");
    assert.equal(await program(other), await program(page));
    await other.locator("#tabs button", { hasText: "plate.ncl" }).click();
    await other.locator(".cm-line", { hasText: "a line of ours" }).waitFor();
    await other.close();
    const broken = await open(`${address}#${link.split("#")[1].slice(0, 40)}`);
    await said(broken, "blocks");
    assert.match(await broken.locator("#said").innerText(), /can't be read/);
    await broken.close();
    await page.close();
  },

  async "texts of a stranger stay texts"() {
    const hurt = `</script><img src="x" onerror="window.hurt = 1">`;
    const cl = `PARTNO / ${hurt}\nUNITS / MM\nLOADTL / 1\nPPRINT / ${hurt}\nFEDRAT / 9, MMPM\nGOTO / 1, 2, 3\nFINI\n`;
    const file = (text) => ({ name: hurt, text });
    const machine = file("base = 'fanuc-mill'\n");
    for (const [text, end] of [[cl, "blocks"], [`${cl.replace("FINI", hurt)}`, "Refused"]]) {
      const state = { cl: file(text), machine, fil: [], includes: [], options: {} };
      const page = await open(`${address}#${await pack(state)}`);
      await said(page, end);
      if (end === "blocks") {
        await page.click("#show-plot");
        await page.frameLocator("#plot iframe").locator("canvas, svg").first().waitFor({ timeout: 10_000 });
      }
      for (const frame of page.frames()) assert.equal(await frame.evaluate(() => window.hurt), undefined);
      await page.close();
    }
  },

  async "a loop without end is refused, and the page goes on"() {
    const page = await open(address);
    await said(page, "blocks");
    await page.locator("#editors > div:not([hidden]) .cm-content").click();
    await page.keyboard.press("Control+Home");
    await page.keyboard.insertText("AGAIN) CONTIN\nJUMPTO/AGAIN\n");
    await said(page, "Refused");
    assert.match(await page.locator("#findings").innerText(), /E0304/);
    await page.keyboard.press("Control+z");
    await said(page, "blocks");
    await page.close();
  },
};

let failed = 0;
for (const [name, test] of Object.entries(tests)) {
  try {
    await test();
    assert.deepEqual(wrong.splice(0), []);
    console.log(`ok      ${name}`);
  } catch (error) {
    failed += 1;
    console.log(`FAILED  ${name}\n${error.stack}`);
  }
}
await browser.close();
console.log(`playground: ${Object.keys(tests).length - failed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
