// What a person does in the studio; the same over each back end.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { COMMON, SECTIONS } from "../src/panes/settings.js";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

const said = (page, text) => page.locator("#status", { hasText: text }).waitFor({ timeout: 15_000 });
const nc = (page) => page.locator("#nc .cm-content").innerText();

/** Begins a post from a ready one. An empty folder asks by itself; the playground has an example. */
async function begin(page, ready) {
  if ((await page.locator("#place").innerText()) === "playground") {
    await said(page, /blocks|Refused/);
    await page.evaluate(() => globalThis.filpost.empty());
  }
  await page.locator(".card", { has: page.getByText(ready, { exact: true }) }).click();
  await said(page, "blocks");
}

/** Types text at the start of the file that is shown. */
async function typeAtTop(page, text) {
  await page.locator("#editors .editor:visible .cm-content").click();
  await page.keyboard.press("Control+Home");
  await page.keyboard.insertText(text);
}

/** The row of a setting in the form. */
const setting = (page, key) => page.locator(`[id="set-${key}"]`);

/** Waits until the program has a text. */
async function shows(page, text) {
  await page.locator("#nc .cm-content", { hasText: text }).waitFor({ timeout: 15_000 });
}

/** A box as binary STL, from corner to corner. */
function binaryBox(low, high) {
  const corner = (bits) => [0, 1, 2].map((axis) => ((bits >> axis) & 1 ? high : low)[axis]);
  const faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
  const triangles = faces.flatMap(([a, b, c, d]) => [[a, b, c], [a, c, d]]);
  const bytes = Buffer.alloc(84 + 50 * triangles.length, 0);
  // A head with an end of line in it: bytes are not a text.
  bytes.write("box\r\n\u0000", 0, "latin1");
  bytes.writeUInt32LE(triangles.length, 80);
  triangles.forEach((three, number) => {
    three.flatMap(corner).forEach((value, at) => bytes.writeFloatLE(value, 84 + 50 * number + 12 + 4 * at));
  });
  return bytes;
}

/** What axe-core finds in a page. */
async function faults(page) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => globalThis.axe.run(document, {
    runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"],
    // It would ask for the style sheets, which a page from a disk may not.
    preload: false,
  }));
  return violations.map(({ id, nodes }) => `${id}: ${nodes.slice(0, 3).map((node) => node.html.slice(0, 160)).join(" | ")}`);
}

const openFile = (page, name) => page.locator(`#tree .name[title="${name}"]`).click();

export const tests = {
  async "from an empty folder to a saved post"(studio) {
    const { page, read, picture, close } = await studio();
    await picture("begin");
    await begin(page, "haas-mill");
    assert.match(await nc(page), /G43 Z50\. H1/);
    await page.keyboard.press("Control+s");
    await page.waitForFunction(() => !document.querySelector("#tree .dirty"));
    assert.match(await read("machine.toml"), /base = "haas-mill"/);
    assert.match(await read("cases/first/expected.nc"), /M30/);
    await picture("saved");
    await close();
  },

  async "a block tells what made it, and a line tells its blocks"(studio) {
    const { page, picture, close } = await studio();
    await begin(page, "fanuc-mill");
    await page.locator("#nc .cm-line", { hasText: "PART 100 FIRST" }).last().click();
    const cause = page.locator("#cause button");
    await cause.first().waitFor();
    const told = await cause.allInnerTexts();
    assert.match(told[0], /cases\/first\/part\.ncl:3.*record 3.*LOADTL \/ 1/s);
    assert.match(told[1], /post\.fil:\d+.*PPRINT HTEXT/s);
    await cause.nth(1).click();
    await page.locator("#open-tabs [aria-selected=true]", { hasText: "post.fil" }).waitFor();
    await page.locator("#nc .marked", { hasText: "PART 100 FIRST" }).waitFor();
    await openFile(page, "cases/first/part.ncl");
    await page.locator("#editors .editor:visible .cm-line", { hasText: "SPINDL" }).first().click();
    await page.locator("#nc .marked", { hasText: "S2000 M3" }).waitFor();
    await page.locator("#word", { hasText: "number of the record" }).waitFor();
    await picture("cause");
    await close();
  },

  async "a finding is repaired"(studio) {
    const { page, picture, close } = await studio();
    await begin(page, "haas-mill");
    const before = await nc(page);
    await openFile(page, "post.fil");
    await typeAtTop(page, "XX = SQRTFF(4)\n");
    await said(page, "Refused");
    assert.equal((await nc(page)).trim(), "");
    await page.locator(".cm-lintRange-error").first().waitFor();
    await picture("refused");
    await page.locator("#findings .repair", { hasText: "write SQRTF" }).click();
    await said(page, "blocks");
    assert.equal(await nc(page), before);
    await page.locator(".cm-content", { hasText: "XX = SQRTF(4)" }).waitFor();
    await close();
  },

  async "five wishes in the form change machine.toml and the program"(studio) {
    const { page, read, picture, close } = await studio();
    await begin(page, "haas-mill");
    // Blocks numbered by five, a number of the program, none of the name, flood by M7, end by M2.
    await setting(page, "seqno.increment").fill("5");
    await setting(page, "seqno.increment").press("Enter");
    await shows(page, /\bN15\b/);
    await page.locator("#cause", { hasText: "The last change" }).waitFor();
    await picture("form");
    await setting(page, "program.number").fill("4711");
    await setting(page, "program.number").press("Enter");
    await shows(page, "O4711");
    await setting(page, "program.name_comment").selectOption("no");
    await page.locator("#nc .cm-content", { hasText: "(100 FIRST)" }).waitFor({ state: "detached" });
    await page.getByRole("searchbox", { name: "Find a setting" }).fill("coolant default");
    await setting(page, "coolant.default_code").fill("7");
    await setting(page, "coolant.default_code").press("Enter");
    await shows(page, "M7");
    await page.getByRole("searchbox", { name: "Find a setting" }).fill("coolant off");
    await setting(page, "coolant.off_code").fill("109");
    await setting(page, "coolant.off_code").press("Enter");
    await shows(page, "M109");
    await page.getByRole("searchbox", { name: "Find a setting" }).fill("");
    await page.keyboard.press("Control+s");
    await page.waitForFunction(() => !document.querySelector("#tree .dirty"));
    const machine = await read("machine.toml");
    for (const line of ["increment = 5", "number = 4711", "name_comment = false", "default_code = 7", "off_code = 109"]) {
      assert.ok(machine.includes(line), `${line} is not in\n${machine}`);
    }
    // What is set here is marked, and can be taken back.
    await page.locator(".setting.own", { hasText: "seqno.increment" }).getByRole("button", { name: "Reset" }).click();
    await page.locator("#nc .cm-content", { hasText: /\bN15\b/ }).waitFor({ state: "detached" });
    await page.locator("#open-tabs [aria-selected=true]", { hasText: "Machine" }).waitFor();
    // A value that the setting can't have is said, and nothing changes.
    await setting(page, "program.number").fill("many");
    await setting(page, "program.number").press("Enter");
    await page.locator(".problem:visible").waitFor();
    await shows(page, "O4711");
    await close();
  },

  async "a setting shows the lines that depend on it"(studio) {
    const { page, picture, close } = await studio();
    await begin(page, "haas-mill");
    await page.getByRole("searchbox", { name: "Find a setting" }).fill("coolant off");
    const row = page.locator(".setting", { has: setting(page, "coolant.off_code") });
    await row.getByRole("button", { name: "Lines of coolant.off_code" }).click();
    await row.locator(".notes", { hasText: /\d lines? \(/ }).waitFor();
    await page.locator("#nc .marked", { hasText: "M9" }).first().waitFor();
    await picture("touches");
    await close();
  },

  async "the form has its sections in order, and each that shops change"(studio) {
    const { page, close } = await studio();
    await begin(page, "haas-mill");
    await page.getByRole("combobox", { name: "Which settings" }).selectOption("all");
    await page.locator(".setting.idle").first().waitFor();
    const rows = await page.evaluate(() => [...document.querySelectorAll(".setting [id^=set-]")].map(({ id }) => id.slice(4)));
    assert.deepEqual([...COMMON].filter((key) => !rows.includes(key)), [], "keys that are no settings");
    const titles = await page.locator(".settings h3").allInnerTexts();
    const known = ["Options of the post", ...SECTIONS.values(), "Blocks of your own"];
    assert.deepEqual(titles, known.filter((title) => titles.includes(title)), "all sections are known, and in order");
    assert.equal(titles.length, known.length, "each section has settings");
    // What acts of those that shops change is there at once.
    await page.getByRole("combobox", { name: "Which settings" }).selectOption("common");
    for (const key of ["program.number", "seqno.increment", "limits.check"]) await setting(page, key).waitFor();
    await close();
  },

  async "an option of a post is chosen in the form"(studio) {
    const { page, read, close } = await studio();
    await begin(page, "haas-mill");
    const before = await nc(page);
    await setting(page, "options.style").selectOption("production");
    await page.waitForFunction((old) => document.querySelector("#nc .cm-content").innerText !== old, before);
    await page.keyboard.press("Control+s");
    await page.waitForFunction(() => !document.querySelector("#tree .dirty"));
    assert.match(await read("machine.toml"), /style = "production"/);
    await close();
  },

  async "a case is saved, and all cases are run"(studio) {
    const { page, read, picture, close } = await studio();
    await begin(page, "haas-mill");
    await page.click("#tab-cases");
    await page.click("#save-case");
    await page.locator("#dialog input").fill("second");
    await page.keyboard.press("Enter");
    await page.locator("#cases li", { hasText: "cases/second" }).waitFor();
    await page.waitForFunction(() => !document.querySelector("#tree .dirty"));
    assert.match(await read("cases/second/case.toml"), /machine = "\.\.\/\.\.\/machine\.toml"/);
    assert.equal(await read("cases/second/expected.nc"), await read("cases/first/expected.nc"));
    await page.click("#run-cases");
    await page.locator("#cases-said", { hasText: "2 cases passed, 0 failed" }).waitFor();
    // What no case runs is said, and marked in the script.
    await page.locator("#coverage li", { hasText: /post\.fil \d+ of \d+ lines/ }).waitFor();
    await openFile(page, "post.fil");
    await typeAtTop(page, "CIMFIL/ON,OPSKIP\n  XX=1\n  DMY=POSTF(13)\nCIMFIL/OFF\n");
    await said(page, "blocks");
    await page.click("#run-cases");
    await page.locator("#coverage .other", { hasText: "line 2 never ran" }).click();
    await page.locator("#editors .editor:visible .missed", { hasText: "XX=1" }).waitFor();
    await picture("coverage");
    await page.getByRole("tab", { name: "Machine", exact: true }).click();
    await setting(page, "seqno.increment").fill("5");
    await setting(page, "seqno.increment").press("Enter");
    await shows(page, /\bN15\b/);
    await page.click("#run-cases");
    await page.locator("#cases-said", { hasText: "0 cases passed, 2 failed" }).waitFor();
    await page.locator("#cases .failed", { hasText: "is expected" }).first().getByRole("button", { name: "Compare" }).click();
    await page.locator("#compare-said", { hasText: /differ|same/ }).waitFor();
    await picture("cases");
    await close();
  },

  async "a program is compared with a proven one in words"(studio) {
    const { page, picture, close } = await studio();
    await begin(page, "haas-mill");
    await openFile(page, "cases/first/part.ncl");
    await page.locator("#editors .editor:visible .cm-line", { hasText: "GOTO / -10, 0, -1" }).click();
    await page.keyboard.press("End");
    await page.keyboard.press("Backspace");
    await page.keyboard.type("3");
    await said(page, "blocks");
    await page.click("#tab-compare");
    await page.locator("#differences li", { hasText: "deeper by 2" }).waitFor();
    await picture("compare");
    await page.locator("#differences .finding").first().click();
    await page.locator("#panel-nc:visible").waitFor();
    await close();
  },

  async "a program that does another thing than its CL file is found"(studio) {
    const { page, close } = await studio();
    await begin(page, "haas-mill");
    await page.locator("#checked", { hasText: "motions agree" }).waitFor({ timeout: 15_000 });
    await openFile(page, "post.fil");
    await typeAtTop(page, "CIMFIL/ON,COOLNT\n  POSTN/OUT,G,1,X,99,F,500\n  DMY = POSTF(13)\nCIMFIL/OFF\n");
    await shows(page, "X99.");
    await page.locator("#findings li", { hasText: "verify" }).first().waitFor({ timeout: 15_000 });
    await close();
  },

  async "a file has an outline, and its names are found and changed"(studio) {
    const { page, picture, close } = await studio();
    await begin(page, "haas-mill");
    // A CL file by tool and operation.
    await openFile(page, "cases/first/part.ncl");
    const outline = page.locator("#outline");
    await outline.getByRole("button", { name: "LOADTL / 1" }).click();
    await page.locator("#word", { hasText: "LOADTL" }).waitFor();
    // A script by sections and macros.
    await openFile(page, "post.fil");
    await outline.getByRole("button", { name: /HEADER/ }).first().waitFor();
    const script = page.locator("#editors .editor:visible");
    await script.locator(".cm-line", { hasText: "CALL/HEADER" }).click();
    await page.keyboard.press("End");
    await page.keyboard.press("F12");
    await script.locator(".cm-activeLine", { hasText: "MACRO" }).waitFor();
    const name = script.locator(".cm-line", { hasText: /^HDONE = 0/ });
    await name.click();
    await page.keyboard.press("Home");
    await page.getByRole("button", { name: "Uses" }).click();
    await page.locator("#dialog li", { hasText: "HDONE.EQ.0" }).waitFor();
    await picture("uses");
    assert.deepEqual(await faults(page), [], "the uses");
    await page.locator("#dialog .close").click();
    const before = await nc(page);
    await name.click();
    await page.keyboard.press("Home");
    await page.keyboard.press("F2");
    await page.locator("#dialog input").fill("BEGUN");
    await page.keyboard.press("Enter");
    await script.locator(".cm-line", { hasText: "BEGUN.EQ.0" }).waitFor();
    await said(page, "blocks");
    assert.equal(await nc(page), before);
    // The call that is written tells its form, and the layout is that of the formatter.
    await typeAtTop(page, "IF (1.EQ.1) THEN\nXX = SQRTF(4)\nENDIF\n");
    await page.getByRole("button", { name: "Format" }).click();
    await script.locator(".cm-line", { hasText: "XX = SQRTF(4)" }).click();
    await page.keyboard.press("End");
    await page.keyboard.press("ArrowLeft");
    await page.locator("#word .call", { hasText: "SQRTF(" }).waitFor();
    await picture("names");
    await close();
  },

  async "the audit lists what a script changed, with the ways there"(studio) {
    const { page, picture, close } = await studio();
    await begin(page, "haas-mill");
    await page.click("#tab-audit");
    const said = page.locator("#audit-said");
    await said.filter({ hasText: "motions of the CL file are made by the post as it asks" }).waitFor();
    await openFile(page, "post.fil");
    await typeAtTop(page, "CIMFIL/ON,SPINDL\n  POSTN/OUT,S,1234,M,3\nCIMFIL/OFF\n");
    await shows(page, "S1234");
    const row = page.locator("#audit-changes li", { hasText: "post.fil:2, section SPINDL" }).first();
    await row.waitFor();
    assert.match(await row.innerText(), /S 2000 -> 1234/);
    await picture("audit");
    assert.deepEqual(await faults(page), [], "the audit");
    await row.getByRole("button", { name: /^CL line/ }).first().click();
    await page.locator("#open-tabs [aria-selected=true]", { hasText: "part.ncl" }).waitFor();
    await row.locator(".finding").click();
    await page.locator("#open-tabs [aria-selected=true]", { hasText: "post.fil" }).waitFor();
    await page.locator("#nc .marked", { hasText: "S1234" }).first().waitFor();
    await row.getByRole("button", { name: /^NC line/ }).first().click();
    await page.locator("#cause", { hasText: "POSTN/OUT,S,1234" }).waitFor();
    await close();
  },

  async "a run stops in a script, a CL file and the program, and goes back"(studio) {
    const { page, picture, close } = await studio();
    await begin(page, "haas-mill");
    await page.click("#tab-debug");
    const place = page.locator("#debug-place"), step = (name) => page.getByRole("button", { name, exact: true }).click();
    // In a script: a line by the key, with its values.
    await openFile(page, "post.fil");
    const script = page.locator("#editors .editor:visible");
    await script.locator(".cm-line", { hasText: "HTEXT =" }).first().click();
    await page.keyboard.press("F9");
    await script.locator(".cm-stops .stop", { hasText: "●" }).last().waitFor();
    await step("Start");
    await place.locator(".where", { hasText: "post.fil" }).first().waitFor();
    await script.locator(".standing", { hasText: "HTEXT =" }).waitFor();
    const value = page.locator("#debug-values tr", { hasText: "HTEXT" }).locator("td");
    const before = await value.innerText();
    await page.keyboard.press("F10");
    await page.waitForFunction((old) => [...document.querySelectorAll("#debug-values tr")]
      .some((row) => row.cells[0].innerText === "HTEXT" && row.cells[1].innerText !== old), before);
    await picture("debugger");
    await step("Back");
    await script.locator(".standing", { hasText: "TEXT/PROG" }).waitFor();
    assert.equal(await value.innerText(), before);
    // In the CL file, under a condition that never holds, and without.
    await page.getByRole("button", { name: /^Remove post\.fil:/ }).click();
    await openFile(page, "cases/first/part.ncl");
    await page.locator("#editors .editor:visible .cm-line", { hasText: "SPINDL" }).first().click();
    await page.keyboard.press("F9");
    await step("Continue");
    await place.locator(".frames", { hasText: "SPINDL" }).waitFor();
    await page.locator("#editors .editor:visible .standing", { hasText: "SPINDL" }).waitFor();
    // In the program: the block that was written last is the one with the breakpoint.
    await page.locator("#nc .cm-line", { hasText: "S2000 M3" }).click();
    await page.keyboard.press("F9");
    await step("Continue");
    await place.locator("p", { hasText: "S2000 M3" }).waitFor();
    await page.locator("#nc .standing", { hasText: "S2000 M3" }).waitFor();
    // A word that stops at each record of its kind, and a value that is shown.
    await page.getByRole("textbox", { name: "Stop at" }).fill("record FEDRAT");
    await page.keyboard.press("Enter");
    await page.getByRole("textbox", { name: "Show" }).fill("POSTF(7,1)");
    await page.keyboard.press("Enter");
    await step("Continue");
    await place.locator(".frames", { hasText: "FEDRAT" }).waitFor();
    await page.locator("#debug-watched", { hasText: /POSTF\(7,1\) \S/ }).waitFor();
    assert.deepEqual(await faults(page), [], "the debugger");
    // Another text has other places.
    await openFile(page, "post.fil");
    await typeAtTop(page, "$$ another text\n");
    await place.locator("p", { hasText: "start again" }).waitFor();
    await close();
  },

  async "stock is cut, and what goes wrong has its block and its CL line"(studio) {
    const { page, read, picture, close } = await studio();
    await begin(page, "haas-mill");
    await page.click("#tab-stock");
    const setup = (name) => page.locator("#stock-form").getByLabel(name);
    await setup("Stock").fill("box:120x80x20@-60,-40,-20");
    await setup("Stock").press("Tab");
    await setup("Tools").fill("1 = D10R1");
    await setup("Tools").press("Tab");
    await page.locator("#stock-said", { hasText: "Nothing was found. Removed" }).or(page.locator("#stock-said", { hasText: /Removed|E09/ })).first().waitFor();
    await picture("stock-clean");
    // Stock that is higher than the part was planned for is hit by a rapid.
    await setup("Stock").fill("box:120x80x120@-60,-40,-20");
    await setup("Stock").press("Tab");
    await page.click("#tab-findings");
    const hit = page.locator("#findings li", { hasText: "E0971" }).first();
    await hit.waitFor();
    await hit.locator(".other", { hasText: "part.ncl" }).click();
    await page.locator("#open-tabs [aria-selected=true]", { hasText: "part.ncl" }).waitFor();
    await hit.locator(".finding").click();
    await page.locator("#cause", { hasText: "part.ncl" }).waitFor();
    await picture("stock-finding");
    await page.click("#tab-stock");
    await page.getByRole("button", { name: "Show in Path" }).click();
    await page.locator(".fv-legend label", { hasText: "feed" }).waitFor();
    // The tool has the size that is given here, and not that of the CL file.
    await page.locator(".fv-state", { hasText: "T1 bull ⌀10 R1" }).waitFor();
    await picture("stock-path");
    await page.click("#tab-stock");
    assert.deepEqual(await faults(page), [], "the stock");
    await page.keyboard.press("Control+s");
    await page.waitForFunction(() => !document.querySelector("#tree .dirty"));
    assert.match(await read("cases/first/stock.toml"), /1 = "D10R1"/);
    await close();
  },

  async "stock and part are binary STL files"(studio, isPlayground) {
    const { page, close } = await studio();
    await begin(page, "haas-mill");
    const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.click("#add")]);
    await chooser.setFiles({ name: "block.stl", mimeType: "model/stl", buffer: binaryBox([-60, -40, -20], [60, 40, 0]) });
    await page.locator('#tree .name[title="block.stl"]').waitFor();
    await page.click("#tab-stock");
    const setup = (name) => page.locator("#stock-form").getByLabel(name);
    for (const [name, text] of [["Stock", "../../block.stl"], ["Tools", "1 = D10"]]) {
      await setup(name).fill(text);
      await setup(name).press("Tab");
    }
    await page.locator("#stock-form").getByLabel("Part").locator("option", { hasText: "../../block.stl" }).waitFor({ state: "attached" });
    const removed = page.locator("#stock-said", { hasText: /Removed [\d,]+ mm³ of 192,000 mm³/ });
    await removed.waitFor();
    if (!isPlayground) {
      // The bytes are the same on the disk, and when they are read again.
      await page.keyboard.press("Control+s");
      await page.waitForFunction(() => !document.querySelector("#tree .dirty"));
      await page.reload();
      await said(page, "blocks");
      await page.click("#tab-stock");
      await removed.waitFor();
    }
    await close();
  },

  async "from an empty folder to an own post: wishes, a stop, a repair, a case"(studio) {
    const { page, read, picture, close } = await studio();
    await begin(page, "haas-mill");
    // Five wishes, in the form.
    const wish = async (key, value) => {
      await page.getByRole("searchbox", { name: "Find a setting" }).fill(key);
      // The list follows the last letter.
      await page.waitForTimeout(400);
      await setting(page, key).fill(value);
      await setting(page, key).press("Enter");
    };
    for (const [key, value, block] of [
      ["program.number", "4711", "O4711"], ["seqno.increment", "5", /\bN15\b/], ["coolant.default_code", "7", "M7"],
      ["coolant.off_code", "109", "M109"], ["spindle.stop_code", "105", "M105"],
    ]) {
      await wish(key, value);
      await shows(page, block);
    }
    // A sentence of FIL with a mistake in it, and its repair.
    await openFile(page, "post.fil");
    await typeAtTop(page, "CIMFIL/ON,COOLNT\n  XX = SQRTFF(16)\n  DMY = POSTF(13)\nCIMFIL/OFF\n");
    await said(page, "Refused");
    await page.locator("#findings .repair", { hasText: "write SQRTF" }).click();
    await said(page, "blocks");
    // What it does is looked at: the run stops in it, and the value is there after the step.
    await page.click("#tab-debug");
    await page.locator("#editors .editor:visible .cm-line", { hasText: "SQRTF(16)" }).click();
    await page.keyboard.press("F9");
    await page.getByRole("button", { name: "Start", exact: true }).click();
    await page.locator("#debug-place .frames", { hasText: "COOLNT" }).waitFor();
    await page.keyboard.press("F10");
    await page.locator("#debug-values tr", { hasText: /^XX\s*4/ }).waitFor();
    await picture("own-post-stop");
    // The part and its program become a case, which passes.
    await page.click("#tab-cases");
    await page.click("#save-case");
    await page.locator("#dialog input").fill("plate");
    await page.keyboard.press("Enter");
    await page.locator("#cases li", { hasText: "cases/plate" }).waitFor();
    await page.waitForFunction(() => !document.querySelector("#tree .dirty"));
    await page.click("#run-cases");
    await page.locator("#cases li.passed", { hasText: "cases/plate" }).waitFor();
    assert.match(await read("cases/plate/expected.nc"), /M109/);
    assert.match(await read("post.fil"), /SQRTF\(16\)/);
    assert.match(await read("machine.toml"), /off_code = 109/);
    await picture("own-post");
    await close();
  },

  async "keys, labels and contrast are as they should be"(studio) {
    const { page, close } = await studio();
    assert.deepEqual(await faults(page), [], "the dialog");
    await begin(page, "haas-mill");
    await page.locator(".setting").first().waitFor();
    assert.deepEqual(await faults(page), [], "the form");
    await openFile(page, "post.fil");
    await page.click("#tab-cases");
    await page.click("#tab-compare");
    assert.deepEqual(await faults(page), [], "the editor");
    // The panes are moved with the keys, and stay so.
    const sash = page.locator("#sash-files");
    await sash.focus();
    const width = () => page.locator("#files").evaluate((pane) => pane.getBoundingClientRect().width);
    const before = await width();
    await page.keyboard.press("ArrowRight");
    assert.equal(Math.round(await width() - before), 20);
    await page.locator("#tab-compare").focus();
    await page.keyboard.press("ArrowLeft");
    await page.locator("#panel-nc:visible").waitFor();
    await close();
  },

  async "panes are moved to other sides, and are there again"(studio, isPlayground) {
    const { page, picture, close } = await studio();
    await begin(page, "haas-mill");
    const box = (id) => page.locator(`#${id}`).boundingBox();
    // With the keys: the program below the editors, the findings at the right of all.
    await page.locator("#move-program").focus();
    await page.keyboard.press("ArrowDown");
    await page.locator("#move-judge").focus();
    await page.keyboard.press("ArrowRight");
    const below = async () => (await box("program")).y > (await box("edit")).y + 100;
    const beside = async () => (await box("judge")).x >= (await box("program")).x + (await box("program")).width;
    assert.ok(await below() && await beside());
    // With the pointer: the files to the right side.
    const grip = await box("move-files");
    await page.mouse.move(grip.x + grip.width / 2, grip.y + grip.height / 2);
    await page.mouse.down();
    await page.mouse.move(1240, 420, { steps: 4 });
    await page.locator('#drop[data-side="right"]').waitFor();
    await picture("pane-moves");
    await page.mouse.up();
    const files = await box("files");
    assert.ok(files.x > (await box("judge")).x);
    // Their edge is at the other side now, and the keys move it as the eye expects.
    await page.locator("#sash-files").focus();
    await page.keyboard.press("ArrowLeft");
    assert.equal(Math.round((await box("files")).width - files.width), 20);
    await page.locator("#sash-program").focus();
    const height = (await box("program")).height;
    await page.keyboard.press("ArrowUp");
    assert.equal(Math.round((await box("program")).height - height), 20);
    assert.deepEqual(await faults(page), [], "the panes elsewhere");
    // The studio has another port the next time, and nothing that is kept for one port.
    if (!isPlayground) await page.evaluate(() => localStorage.clear());
    page.on("dialog", (dialog) => dialog.accept());
    await page.reload();
    await page.locator("#files").waitFor();
    assert.ok(await below() && await beside(), "after a reload");
    assert.equal(Math.round((await box("files")).width - files.width), 20);
    if (!isPlayground) await page.locator("#dialog .close").click();
    for (const name of ["program", "judge", "files"]) {
      await page.locator(`#move-${name}`).focus();
      await page.keyboard.press("Home");
    }
    assert.ok((await box("files")).x < 10 && (await box("program")).y < (await box("judge")).y);
    await close();
  },

  async "on a phone one pane is shown at a time"(studio) {
    const { page, picture, close } = await studio({ viewport: { width: 390, height: 780 } });
    await begin(page, "haas-mill");
    await page.locator(".setting").first().waitFor();
    await picture("phone-form");
    await page.locator("#views button", { hasText: "Program" }).click();
    await page.locator("#nc:visible").waitFor();
    await picture("phone-program");
    const wide = await page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
    assert.equal(wide, false, "nothing is wider than the screen");
    assert.deepEqual(await faults(page), []);
    await close();
  },

  async "a large part is posted on demand, with a way to stop"(studio, isPlayground) {
    const { page, picture, close } = await studio();
    await begin(page, "haas-mill");
    const before = await nc(page);
    // 9 MB of CL text in the part that is shown.
    const lines = Array.from({ length: 330_000 }, (_, at) => `GOTO / ${(at % 977) / 10}, ${(at % 1013) / 10}, -1.0000`);
    const text = `UNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\nFEDRAT / 300, MMPM\n${lines.join("\n")}\nFINI\n`;
    const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.click("#add")]);
    await chooser.setFiles({ name: "large.ncl", mimeType: "text/plain", buffer: Buffer.from(text) });
    await page.locator("#stop").click();
    await said(page, "Stopped");
    assert.equal(await nc(page), before);
    await page.click("#post-now");
    await page.locator("#progress:visible").waitFor();
    if (!isPlayground) await page.waitForFunction(() => document.querySelector("#progress").value > 0, null, { timeout: 60_000 });
    await picture("large");
    await page.locator("#status", { hasText: "of 330,005 records" }).waitFor({ timeout: 120_000 });
    await page.locator("#stop").waitFor({ state: "hidden" });
    // A change does not post it by itself.
    await typeAtTop(page, "$$ a change\n");
    await page.waitForTimeout(600);
    await page.locator("#stop").waitFor({ state: "hidden" });
    await close();
  },

  async "texts of a stranger stay texts"(studio) {
    const { page, close } = await studio();
    await begin(page, "haas-mill");
    const hurt = `<img src="x" onerror="window.hurt = 1"></script><script>window.hurt = 2</script>`;
    await openFile(page, "cases/first/part.ncl");
    await typeAtTop(page, `PARTNO / ${hurt}\nPPRINT ${hurt}\n${hurt}\n`);
    await said(page, /blocks|Refused/);
    await page.waitForTimeout(500);
    await page.locator("#findings li").first().waitFor();
    await openFile(page, "machine.toml");
    await typeAtTop(page, `name = "${hurt.replaceAll('"', "'")}"\n`);
    await page.waitForTimeout(800);
    assert.equal(await page.evaluate(() => window.hurt), undefined);
    await close();
  },

  async "a block shows its motions, and a motion its block"(studio) {
    const { page, picture, close } = await studio();
    await begin(page, "haas-mill");
    await page.getByRole("tab", { name: "Path" }).click();
    const block = page.locator(".fv-block");
    await page.locator(".fv-legend label", { hasText: "feed" }).waitFor();
    const line = page.locator("#nc .cm-line", { hasText: /X\d/ }).last(), text = (await line.innerText()).trim();
    await line.click();
    await page.locator(".fv-block", { hasText: text }).waitFor();
    await picture("path");
    // Beside the middle of the marked motion, where the tool stands at its end, lies its line.
    await page.getByRole("button", { name: "One motion back" }).click();
    assert.notEqual(await block.innerText(), "");
    await page.locator("#second").selectOption({ label: "cases/first/part.ncl" });
    await page.locator(".fv-legend label", { hasText: "part.ncl" }).waitFor();
    await picture("path-over-cl");
    await close();
  },
};
