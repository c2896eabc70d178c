// Uses the 3D view as a person does: node tests/view.mjs CHROMIUM [FOLDER FOR SCREENSHOTS].
import assert from "node:assert/strict";
import { mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";
import { chromium } from "playwright-core";
import { makeColumns, manyMotions } from "./columns.mjs";

const [executablePath, pictures] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
/** Motions of a long program, most draw calls of a picture of it. */
const MANY = 1_500_000, CALLS = 200;

const half = Array.from({ length: 24 }, (_, at) => {
  const angle = (at + 1) / 24 * Math.PI;
  return [50 + 15 * Math.sin(angle), 15 - 15 * Math.cos(angle), -2];
});
const SLOT = {
  title: "slot", start: [0, 0, 10], force: [[0, 1, 500, 3000], [4, 2, 250, 1200]],
  tools: [{ number: 1, diameter: 8, corner: 2, bottom: 0, length: 24 }, { number: 2, diameter: 6, corner: 0, bottom: 31, length: 30 }],
  moves: [[0, 1, [0, 0, 2]], [1, 2, [0, 0, -2]], [1, 3, [50, 0, -2]], [2, 4, ...half], [1, 5, [0, 30, -2]], [0, 6, [0, 30, 10]]],
};
const TEXT = ["G0 Z2.", "G1 Z-2. F500.", "X50.", "G3 X50. Y30. R15.", "G1 X0.", "G0 Z10."];
/** Beside the slot, and 5 mm larger. */
const PROVEN = { ...SLOT, title: "proven.nc", moves: [[1, 1, [0, -5, -2]], [1, 2, [70, -5, -2]], [1, 3, [70, 35, -2]]] };
const TABLE = {
  title: "table", start: [0, 0, 20], axes: [[0, [0, 0, 1]], [1, [0, -1, 0]]], rotary: [[0, [0, 0]], [1, [90, 0]]],
  moves: [[1, 1, [40, 0, 20]], [1, 2, [40, -20, 0]]],
  chain: { axes: [{ letter: "A", carries: "table", direction: [1, 0, 0], center: [0, 0, 0] }, null], tool: [0, 0, 1] },
};
const SHAFT = {
  title: "shaft", lathe: true, diameter: true, start: [30, 0, 5], force: [[0, 1, 200, 900]],
  moves: [[0, 1, [20, 0, 2]], [1, 2, [20, 0, -40]], [1, 3, [25, 0, -45]], [3, 4, [25, 0, -80]]],
};

const harness = `import { bytesOf, createView, readProgram } from "./view/index.js";
import "./view/view.css";
globalThis.picked = [];
globalThis.texts = [];
globalThis.view = createView(document.getElementById("view"), { onPick: (...what) => picked.push(what), textOf: (line) => texts[line - 1] ?? "" });
globalThis.read = (base64) => readProgram(bytesOf(base64));
globalThis.readProgram = readProgram;
/** Pixels of the picture that have a color of the style sheet. */
globalThis.count = (name) => {
  view.drawNow();
  const gl = view.renderer.getContext(), { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
  const pixels = new Uint8Array(4 * width * height), hex = view.theme[name];
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  const wanted = [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
  let found = 0;
  for (let at = 0; at < pixels.length; at += 4) if (wanted.every((value, n) => Math.abs(pixels[at + n] - value) < 6)) found++;
  return found;
};
/** Where a point of the part is on the page. */
globalThis.placeOf = (...point) => {
  view.drawNow();
  const box = view.canvas.getBoundingClientRect(), at = view.camera.project(view.point.clone().set(...point).applyMatrix4(view.part.matrixWorld), view.point.clone());
  return [box.left + at.x, box.top + at.y];
};`;
const made = await build({
  stdin: { contents: harness, resolveDir: join(here, "../src") }, bundle: true, format: "iife", target: "es2022", write: false, outdir: "out",
});
const [script, style] = [".js", ".css"].map((end) => made.outputFiles.find(({ path }) => path.endsWith(end)).text);

const profile = mkdtempSync(join(tmpdir(), "filpost-view-"));
const context = await chromium.launchPersistentContext(profile, {
  executablePath, headless: true, viewport: { width: 1200, height: 760 },
  args: [
    "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
  ],
});
await context.setOffline(true);
const wrong = [];

async function open(program = SLOT, { width = 1200, height = 760, scheme = "light" } = {}) {
  const page = await context.newPage();
  page.on("pageerror", (error) => wrong.push(`the page threw ${error}`));
  page.on("console", (message) => message.type() === "error" && wrong.push(message.text()));
  await page.setViewportSize({ width, height });
  await page.emulateMedia({ colorScheme: scheme });
  await page.setContent('<!doctype html><html lang="en"><head><title>view</title><meta name="viewport" content="width=device-width"></head><body style="margin:0"><div id="view" style="height:100vh"></div></body></html>');
  await page.addStyleTag({ content: style });
  await page.addScriptTag({ content: script });
  await page.evaluate((text) => (texts = text), TEXT);
  if (program) await show(page, program);
  return page;
}

const base64 = (program) => Buffer.from(makeColumns(program)).toString("base64");
const show = (page, program) => page.evaluate((columns) => view.setProgram(read(columns)), base64(program));
const lay = (page, program) => page.evaluate((columns) => view.setSecond(columns && read(columns)), program && base64(program));
const count = (page, name) => page.evaluate((colour) => count(colour), name);
const placeOf = (page, ...point) => page.evaluate((point) => placeOf(...point), point);
const text = (page, part) => page.locator(`.fv-${part}`).innerText();
const near = (actual, expected, within = 0.6) =>
  expected.forEach((value, at) => assert.ok(Math.abs(actual[at] - value) <= within, `${actual} is not ${expected}`));

async function picture(page, name) {
  if (!pictures) return;
  mkdirSync(pictures, { recursive: true });
  await page.screenshot({ path: join(pictures, `${name}.png`) });
}

const tests = {
  async "rapids, feeds and arcs have their colors, in the legend too"() {
    const page = await open();
    for (const name of ["rapid", "feed", "arc"]) assert.ok((await count(page, name)) > 40, name);
    assert.equal(await text(page, "legend"), "rapidfeedarc".replaceAll(/(rapid|feed)/g, "$1\n"));
    await page.getByRole("checkbox", { name: "arc" }).uncheck();
    assert.equal(await count(page, "arc"), 0);
    await page.getByRole("combobox", { name: "Color by" }).selectOption({ label: "by tool" });
    assert.match(await text(page, "legend"), /T1 bull ⌀8 R2\s+T2 drill ⌀6/);
    assert.ok((await page.evaluate(() => (view.theme.second = view.theme.tools[1], count("second")))) > 40, "the second tool");
    await page.getByRole("combobox", { name: "Color by" }).selectOption({ label: "by feed" });
    assert.match(await text(page, "legend"), /250 to 500 mm\/min/);
    await page.close();
  },

  async "a click on a motion names its line and marks it"() {
    const page = await open();
    await page.mouse.click(...(await placeOf(page, 25, 0, -2)));
    assert.deepEqual(await page.evaluate(() => picked), [[3, "program"]]);
    assert.equal(await text(page, "block"), "3: X50.");
    assert.match(await text(page, "force"), /X50 Y0 Z-2 · T1 bull ⌀8 R2 · G54 · F 500 mm\/min · S 3000 rpm clockwise/);
    assert.ok((await count(page, "mark")) > 100, "it is marked");
    await page.mouse.click(1100, 200);
    assert.equal((await page.evaluate(() => picked)).length, 1, "beside the path there is nothing");
    await page.close();
  },

  async "select marks a line and moves it into the middle"() {
    const page = await open();
    assert.equal(await page.evaluate(() => view.select(5)), true);
    const box = await page.locator("canvas").boundingBox();
    near(await placeOf(page, 25, 30, -2), [box.x + box.width / 2, box.y + box.height / 2], 1);
    assert.ok((await count(page, "mark")) > 100);
    assert.equal(await text(page, "block"), "5: G1 X0.");
    assert.equal(await page.evaluate(() => view.select(99)), false);
    assert.equal(await page.evaluate(() => view.mark.mesh), null);
    await page.close();
  },

  async "playback moves the tool at its feed, with block, F, S and T"() {
    const page = await open();
    // 8 mm at 10 m/min, 4 mm and 25 of 50 mm at 500 mm/min.
    const seconds = 8 / 10000 * 60 + 4 / 500 * 60 + 25 / 500 * 60;
    const at = await page.evaluate((time) => {
      view.setTime(time);
      return view.point.toArray();
    }, seconds);
    near(at, [25, 0, -2], 1e-3);
    assert.equal(await text(page, "block"), "3: X50.");
    assert.ok((await count(page, "ghost")) > 100, "the rest is faint");
    assert.equal(await count(page, "arc"), 0);
    await picture(page, "view-tool");
    await page.getByRole("button", { name: "One motion on" }).click();
    near(await page.evaluate(() => view.point.toArray()), [50, 30, -2], 1e-3);
    await page.getByRole("combobox", { name: "Speed of playback" }).selectOption("10");
    await page.getByRole("button", { name: "Play" }).click();
    await page.getByRole("button", { name: "Pause" }).waitFor();
    await page.getByRole("button", { name: "Play" }).waitFor();
    near(await page.evaluate(() => view.point.toArray()), [0, 30, 10], 1e-3);
    assert.ok((await count(page, "rapid")) > 40, "all of it is drawn");
    await page.close();
  },

  async "a second program lies over the first in a color of its own"() {
    const page = await open();
    assert.equal(await count(page, "second"), 0);
    await lay(page, PROVEN);
    assert.ok((await count(page, "second")) > 200);
    assert.match(await text(page, "legend"), /proven\.nc/);
    await page.evaluate(() => view.fit());
    await page.mouse.click(...(await placeOf(page, 70, 15, -2)));
    assert.deepEqual(await page.evaluate(() => picked), [[3, "second"]]);
    await picture(page, "view-two");
    await page.getByRole("checkbox", { name: "proven.nc" }).uncheck();
    assert.equal(await count(page, "second"), 0);
    await lay(page, null);
    assert.doesNotMatch(await text(page, "legend"), /proven/);
    await page.close();
  },

  async "a drag turns about the point under the hand, the wheel zooms to it"() {
    const page = await open();
    const point = [50, 0, -2], place = await placeOf(page, ...point), other = await placeOf(page, 0, 30, 10);
    await page.mouse.move(...place);
    await page.mouse.down();
    await page.mouse.move(place[0] + 60, place[1] + 25, { steps: 5 });
    await page.mouse.up();
    near(await placeOf(page, ...point), place);
    assert.ok(Math.abs((await placeOf(page, 0, 30, 10))[0] - other[0]) > 20, "it has turned");
    await page.mouse.move(...place);
    await page.mouse.wheel(0, -400);
    await page.waitForTimeout(100);
    near(await placeOf(page, ...point), place);
    assert.deepEqual(await page.evaluate(() => picked), [], "a drag picks nothing");
    await page.close();
  },

  async "two clicks measure"() {
    const page = await open();
    await page.getByRole("button", { name: "Measure" }).click();
    assert.equal(await text(page, "distance"), "click the first point");
    await page.mouse.click(...(await placeOf(page, 0, 0, -2)));
    await page.mouse.click(...(await placeOf(page, 50, 30, -2)));
    assert.equal(await text(page, "distance"), "58.31 mm · dx 50 · dy 30 · dz 0");
    await picture(page, "view-measure");
    await page.keyboard.press("Escape");
    assert.equal(await page.locator(".fv-distance").isHidden(), true);
    await page.close();
  },

  async "a section hides what lies beyond it"() {
    const page = await open();
    const whole = await count(page, "feed");
    await page.getByRole("combobox", { name: "Section" }).selectOption({ label: "section Y" });
    const cut = await count(page, "feed");
    assert.ok(cut < 0.7 * whole && cut > 0.2 * whole, `${cut} of ${whole}`);
    assert.equal(await text(page, "section"), "Y ≤ 15");
    await page.getByRole("combobox", { name: "Section" }).selectOption({ label: "no section" });
    assert.equal(await count(page, "feed"), whole);
    await page.close();
  },

  async "a table turns the part, and the tool stays upright"() {
    const page = await open(TABLE);
    assert.match(await text(page, "force"), /A90 /);
    await page.getByRole("button", { name: "Machine" }).click();
    const [axis, tip] = await page.evaluate(() => {
      view.drawNow();
      const upright = view.axis.clone().transformDirection(view.part.matrixWorld);
      return [upright.toArray(), view.point.clone().applyMatrix4(view.part.matrixWorld).toArray()];
    });
    near(axis, [0, 0, 1], 1e-6);
    near(tip, [40, 0, 20], 1e-4);
    await picture(page, "view-table");
    await page.close();
  },

  async "a lathe lies, with diameters"() {
    const page = await open(SHAFT);
    await page.getByRole("button", { name: "Front" }).click();
    const left = await placeOf(page, 20, 0, -40), right = await placeOf(page, 20, 0, 2), up = await placeOf(page, 30, 0, 2);
    assert.ok(right[0] > left[0] && up[1] < right[1], "Z to the right, X up");
    assert.match(await text(page, "force"), /^⌀50 Z-80 · T1 · G54 · F 200/);
    await picture(page, "view-lathe");
    await page.close();
  },

  async "keys turn, step and play"() {
    const page = await open();
    await page.locator("canvas").focus();
    const up = () => page.evaluate(() => view.camera.toward.toArray());
    await page.keyboard.press("1");
    near(await up(), [0, 0, 1], 1e-6);
    await page.keyboard.press("2");
    near(await up(), [0, -1, 0], 1e-6);
    await page.keyboard.press("ArrowRight");
    assert.ok(Math.abs((await up())[0]) > 0.05);
    await page.keyboard.press("Home");
    await page.keyboard.press(".");
    assert.equal(await text(page, "block"), "2: G1 Z-2. F500.");
    await page.keyboard.press(" ");
    await page.getByRole("button", { name: "Pause" }).waitFor();
    await page.keyboard.press(" ");
    await page.getByRole("button", { name: "Play" }).waitFor();
    await page.close();
  },

  async "gaps are listed, and nothing is a picture too"() {
    const page = await open({ ...SLOT, leftOut: [{ line: 7, count: 2, why: "the machine has no G187" }] });
    await page.locator(".fv-missing summary").click();
    assert.equal(await text(page, "missing"), "1 gap in the path\n\nline 7 to 8: the machine has no G187");
    await page.evaluate(() => view.setProgram(null));
    assert.equal(await page.getByRole("button", { name: "Play" }).isDisabled(), true);
    assert.equal(await page.locator(".fv-missing").isHidden(), true);
    await page.evaluate(() => view.drawNow());
    await show(page, { ...SLOT, moves: [] });
    await page.evaluate(() => view.drawNow());
    await show(page, SLOT);
    assert.ok((await count(page, "feed")) > 40);
    await page.evaluate(() => view.dispose());
    assert.equal(await page.locator("#view > *").count(), 0);
    await page.close();
  },

  async "axe finds nothing, in light and dark"() {
    for (const scheme of ["light", "dark"]) {
      const page = await open({ ...SLOT, leftOut: [{ line: 7, count: 1, why: "the machine has no G187" }] }, { scheme });
      await lay(page, PROVEN);
      await page.addScriptTag({ path: createRequire(import.meta.url).resolve("axe-core") });
      const found = await page.evaluate(async () => (await axe.run("#view")).violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 90))}`));
      assert.deepEqual(found, []);
      await page.close();
    }
  },

  async "a body of stock lies under the path"() {
    const page = await open();
    await page.evaluate(() => {
      const positions = new Float32Array([-10, -10, -3, 80, -10, -3, 80, 40, -3, -10, 40, -3]);
      view.setStock({ positions, indices: new Uint32Array([0, 1, 2, 0, 2, 3]) });
    });
    const middle = await page.evaluate(() => {
      view.drawNow();
      const gl = view.renderer.getContext(), pixel = new Uint8Array(4), [x, y] = placeOf(30, 15, -3), box = view.canvas.getBoundingClientRect();
      view.drawNow();
      gl.readPixels(x - box.left, gl.drawingBufferHeight - (y - box.top), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      return [...pixel].slice(0, 3);
    });
    assert.ok(middle[0] < 245 && middle[0] > 120, `the surface: ${middle}`);
    const over = await count(page, "feed");
    await picture(page, "view-stock");
    await page.evaluate(() => view.setStock(null));
    const bare = await count(page, "feed");
    assert.ok(over > 0.8 * bare && bare > 50, `the path is seen: ${over} of ${bare}`);
    await page.close();
  },

  async "all of it fits a phone, in the dark too"() {
    const page = await open(SLOT, { width: 360, height: 700, scheme: "dark" });
    await lay(page, PROVEN);
    await page.evaluate(() => view.look("iso"));
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.equal(wide, 360);
    const boxes = await page.locator(".fv button:visible, .fv select:visible, .fv input:visible").evaluateAll((all) =>
      all.map((one) => [one.title || one.ariaLabel || one.textContent, one.getBoundingClientRect().toJSON()]));
    for (const [name, { left, right }] of boxes) assert.ok(left >= 0 && right <= 360, `${name} is cut: ${left} to ${right}`);
    assert.ok((await page.locator("canvas").boundingBox()).height > 350, "room for the picture");
    for (const name of ["rapid", "feed", "arc", "second"]) assert.ok((await count(page, name)) > 20, name);
    await picture(page, "view-phone");
    await page.close();
  },

  async "1.5 million motions are few draw calls"() {
    const page = await open(null);
    const bytes = Buffer.from(manyMotions(MANY)).toString("base64");
    const said = await page.evaluate(async (columns) => {
      const timed = (work) => {
        const start = performance.now();
        work();
        return performance.now() - start;
      };
      const shown = timed(() => view.setProgram(read(columns)));
      view.drawNow();
      const times = [];
      let calls = 0;
      for (let turn = 0; turn < 20; turn++) {
        view.camera.turn(8, 3, view.middle());
        times.push(timed(() => view.setTime(100 + 600 * turn)) + view.drawNow().milliseconds);
        calls = Math.max(calls, view.stats.calls);
      }
      const picked = timed(() => view.find(600, 400));
      times.sort((a, b) => a - b);
      return { shown, calls, middle: times[10], worst: times[19], picked };
    }, bytes);
    assert.ok(said.calls > 1 && said.calls <= CALLS, `${said.calls} calls`);
    const ms = (value) => value.toFixed(1);
    console.log(`${MANY} motions: ${said.calls} draw calls, ${ms(said.middle)} ms of script a picture (worst ${ms(said.worst)}), shown after ${ms(said.shown)} ms, ` +
      `a click finds its motion in ${ms(said.picked)} ms`);
    await page.close();
  },
};

let failed = 0;
for (const [name, test] of Object.entries(tests)) {
  try {
    await test();
    assert.deepEqual(wrong, []);
    console.log(`ok: ${name}`);
  } catch (error) {
    failed++;
    wrong.length = 0;
    console.log(`FAILED: ${name}\n${error.stack}`);
  }
}
await context.close();
rmSync(profile, { recursive: true, force: true });
process.exitCode = failed ? 1 : 0;
