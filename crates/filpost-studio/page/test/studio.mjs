// What a person does in the studio to make a post; the same over each back end.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { COMMON, SECTIONS } from "../src/panes/settings.js";
import { addFile, begin, faults, nc, openFile, said, setting, shows, typeAtTop } from "./steps.mjs";

export const making = {
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
    // Each word of a block has its own: the feed that of FEDRAT.
    await page.locator("#nc .cm-line", { hasText: "F300." }).first().click();
    await page.locator("#words button", { hasText: "F300." }).click();
    await page.locator("#words [aria-pressed=true]", { hasText: "F300." }).waitFor();
    await page.locator("#cause button", { hasText: /record \d+, word \d+.*FEDRAT \/ 300/s }).waitFor();
    await page.locator("#editors .editor:visible .marked", { hasText: "FEDRAT / 300" }).waitFor();
    await picture("words");
    assert.deepEqual(await faults(page), [], "the words");
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

  async "what the post and the check find is repaired in place"(studio) {
    const { page, picture, close } = await studio();
    await begin(page, "haas-mill");
    const before = await nc(page);
    const repair = (text) => page.locator("#findings .repair", { hasText: text });
    await openFile(page, "cases/first/part.ncl");
    // A misspelt word, and one that the machine does not know.
    await typeAtTop(page, "COOLNTT / OFF\nSITEWD / 5\n");
    await said(page, "Refused");
    await repair("write COOLNT").click();
    await repair("ignore SITEWD on this machine").click();
    await said(page, "blocks");
    await page.locator("#tree .dirty[title='machine.toml']").waitFor();
    // A block of a script that the CL file does not ask for.
    await openFile(page, "post.fil");
    await typeAtTop(page, "CIMFIL/ON,SPINDL\n  POSTN/OUT,G,1,X,99,F,500\n  DMY = POSTF(13)\nCIMFIL/OFF\n");
    await shows(page, "X99.");
    await repair("make post.fil:2 a comment").first().waitFor({ timeout: 15_000 });
    await picture("repairs");
    await repair("make post.fil:2 a comment").first().click();
    await page.locator("#editors .editor:visible .cm-line", { hasText: "$$   POSTN/OUT" }).waitFor();
    await page.locator("#nc .cm-content", { hasText: "X99." }).waitFor({ state: "detached" });
    // A block that the check can't read: what it does is said in the machine.
    await openFile(page, "cases/first/part.ncl");
    await page.locator("#editors .editor:visible .cm-line", { hasText: "COOLNT / OFF" }).last().click();
    await page.keyboard.press("Home");
    await page.keyboard.insertText("INSERT / G65 P9001\n");
    await page.locator("#findings li.note", { hasText: "Not compared" }).getByText("Repair: say that G65 P9001 changes nothing").click({ timeout: 15_000 });
    await openFile(page, "machine.toml");
    await page.locator("#outline").getByRole("button", { name: "effects" }).click();
    await page.locator("#editors .editor:visible .cm-line", { hasText: '"G65 P9001" = "nothing"' }).waitFor();
    assert.notEqual(await nc(page), before);
    assert.deepEqual(await faults(page), [], "the repairs");
    await close();
  },

  async "a name is found in all files, the program and the settings"(studio) {
    const { page, picture, close } = await studio();
    await begin(page, "haas-mill");
    await openFile(page, "post.fil");
    // A macro, from the word at the cursor.
    await page.locator("#editors .editor:visible .cm-line", { hasText: "CALL/HEADER" }).click();
    await page.keyboard.press("End");
    await page.keyboard.press("Control+Shift+F");
    const places = page.locator("#search-places"), said = page.locator("#search-said");
    await places.locator("b", { hasText: "macro" }).waitFor();
    await places.locator("b", { hasText: "call" }).waitFor();
    assert.equal(await page.locator("#search-text").inputValue(), "HEADER");
    await places.locator(".finding", { hasText: "MACRO" }).click();
    await page.locator("#editors .editor:visible .cm-activeLine", { hasText: "MACRO" }).waitFor();
    // A statement: in the part of a case that was not opened yet. Only whole names count, unless that is switched off.
    await page.locator("#search-text").fill("spindl");
    await places.locator("h3", { hasText: "cases/first/part.ncl" }).waitFor();
    await picture("search");
    assert.deepEqual(await faults(page), [], "the places");
    await page.locator("#search-text").fill("spind");
    await said.filter({ hasText: "Settings" }).or(said.filter({ hasText: "place" })).waitFor();
    await places.locator("h3", { hasText: "cases/first/part.ncl" }).waitFor({ state: "detached" });
    await page.locator("#search-whole").uncheck();
    await places.locator("h3", { hasText: "cases/first/part.ncl" }).waitFor();
    // A setting: where machine.toml gives it, and in the form.
    await page.getByRole("tab", { name: "Machine", exact: true }).click();
    await setting(page, "seqno.increment").fill("5");
    await setting(page, "seqno.increment").press("Enter");
    await page.locator("#search-text").fill("seqno.increment");
    await places.locator("h3", { hasText: "machine.toml" }).waitFor();
    await places.locator(".finding", { hasText: "seqno.increment" }).last().click();
    await page.waitForFunction(() => document.activeElement.id === "set-seqno.increment");
    await close();
  },

  async "five wishes in the form change machine.toml and the program"(studio) {
    const { page, read, picture, close } = await studio();
    await begin(page, "haas-mill");
    // Blocks numbered by five, a number of the program, none of the name, flood by M7, end by M2.
    await setting(page, "seqno.increment").fill("5");
    await setting(page, "seqno.increment").press("Enter");
    await shows(page, "N15 G53");
    await page.locator("#cause", { hasText: "The last change" }).waitFor();
    await picture("form");
    await setting(page, "program.number").fill("4711");
    await setting(page, "program.number").press("Enter");
    await shows(page, "O04711");
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
    await shows(page, "O04711");
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
    await setting(page, "options.style").selectOption("plain");
    await page.waitForFunction((old) => document.querySelector("#nc .cm-content").innerText !== old, before);
    await page.keyboard.press("Control+s");
    await page.waitForFunction(() => !document.querySelector("#tree .dirty"));
    assert.match(await read("machine.toml"), /style = "plain"/);
    await close();
  },

  async "an option file becomes a post"(studio) {
    const { page, read, close } = await studio();
    if ((await page.locator("#place").innerText()) === "playground") {
      await said(page, /blocks|Refused/);
      await page.evaluate(() => globalThis.filpost.empty());
    }
    const shop = (name) => readFileSync(join(dirname(fileURLToPath(import.meta.url)), "../../../../tests/cases/option-files", name));
    const [chooser] = await Promise.all([
      page.waitForEvent("filechooser"), page.getByRole("button", { name: "Import an option file…" }).click(),
    ]);
    await chooser.setFiles({ name: "brackets.p07", mimeType: "text/plain", buffer: shop("brackets.p07") });
    await page.locator('#tree .name[title="machine.toml"]').waitFor();
    await addFile(page, "brackets.ncl", shop("brackets.ncl"));
    await shows(page, "[HELLO]");
    await page.keyboard.press("Control+s");
    await page.waitForFunction(() => !document.querySelector("#tree .dirty"));
    assert.match(await read("machine.toml"), /\[/);
    await close();
  },

  async "a script has hints and folds"(studio) {
    const { page, picture, close } = await studio();
    await begin(page, "haas-mill");
    await openFile(page, "post.fil");
    const script = page.locator("#editors .editor:visible");
    await typeAtTop(page, "CIMFIL/ON,SPINDL\n  XX = POSTF(7,4)\n  DMY = POSTF(13)\nCIMFIL/OFF\n");
    await script.locator(".cm-line", { hasText: "POSTF(7" }).locator(".beside").first().waitFor();
    await picture("hints");
    await script.locator(".cm-foldGutter [title='Fold line']").first().click();
    await script.locator(".cm-foldPlaceholder").waitFor();
    await script.locator(".cm-line", { hasText: "POSTF(7" }).waitFor({ state: "detached" });
    assert.deepEqual(await faults(page), [], "the hints");
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
    await script.locator(".cm-line", { hasText: /^ +XX = SQRTF\(4\)/ }).click();
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
      ["program.number", "4711", "O04711"], ["seqno.increment", "5", "N15 G53"], ["coolant.default_code", "7", "M7"],
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
};
