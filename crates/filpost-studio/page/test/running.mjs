// What a person does with a post in the studio: cases, comparing, checking, debugging, cutting; the same over each back end.
import assert from "node:assert/strict";
import { lineDifference, whole } from "../src/backends/texts.js";
import { begin, binaryBox, faults, nc, openFile, said, setting, shows, typeAtTop } from "./steps.mjs";

export const running = {
  async "a text is said by the lines that differ, and put together again"() {
    const rows = (count) => Array.from({ length: count }, (_, at) => `N${at} X${at % 7}.\r\n`).join("");
    const old = rows(2000);
    for (const other of [
      old, old.replace("N9 X2.", "N9 X3."), old.replace("N9 X2.\r\n", ""), `%\n${old}`, `${old}M30`, old.slice(0, -9), rows(1000), "", rows(1),
    ]) {
      for (const [one, two] of [[old, other], [other, old]]) {
        const answer = { nc: lineDifference(one, two) };
        whole(answer, one);
        assert.equal(answer.nc, two);
        const { line, gone, text } = answer.change, before = one.split("\n"), made = text.split("\n");
        const isEnd = line + gone >= before.length;
        const lines = [...before.slice(0, line), ...(isEnd ? made : made.slice(0, -1)), ...(isEnd ? [] : before.slice(line + gone))];
        assert.deepEqual(lines, two.split("\n"), JSON.stringify({ line, gone, text: text.slice(0, 60) }));
      }
    }
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
    await shows(page, "N15 G53");
    await page.click("#run-cases");
    await page.locator("#cases-said", { hasText: "0 cases passed, 2 failed" }).waitFor();
    await page.locator("#cases .failed", { hasText: "is expected" }).first().getByRole("button", { name: "Compare" }).click();
    await page.locator("#compare-said", { hasText: /differ|same/ }).waitFor();
    await picture("cases");
    // Options of the post in a case, and a comparison that leaves the block numbers out.
    await openFile(page, "cases/second/case.toml");
    await typeAtTop(page, 'ignore = ["n"]\noptions.tool-list = "yes"\n');
    await page.click("#run-cases");
    await page.locator("#cases-said", { hasText: "1 case passed, 1 failed" }).waitFor();
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

  async "a large part is posted on demand, with a way to stop"(studio) {
    const { page, picture, close } = await studio();
    await begin(page, "haas-mill");
    const before = await nc(page);
    // 9 MB of CL text in the part that is shown.
    const lines = Array.from({ length: 330_000 }, (_, at) => `GOTO / ${(at % 977) / 10}, ${(at % 1013) / 10}, -1.0000`);
    const text = `UNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\nFEDRAT / 300, MMPM\n${lines.join("\n")}\nFINI\n`;
    const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.click("#add")]);
    await chooser.setFiles({ name: "large.ncl", mimeType: "text/plain", buffer: Buffer.from(text) });
    // At the first picture that has the button: the run may be over soon.
    await page.waitForFunction(() => {
      const stop = document.querySelector("#stop");
      if (!stop.hidden) stop.click();
      return !stop.hidden;
    });
    await said(page, "Stopped");
    assert.equal(await nc(page), before);
    const grows = page.waitForFunction(() => {
      const { hidden, value } = document.querySelector("#progress");
      return !hidden && value > 0;
    }, null, { timeout: 60_000 });
    await page.click("#post-now");
    await grows;
    await picture("large");
    await page.locator("#status", { hasText: "of 330,005 records" }).waitFor({ timeout: 120_000 });
    await page.locator("#stop").waitFor({ state: "hidden" });
    // A change does not post it by itself.
    await typeAtTop(page, "$$ a change\n");
    await page.waitForTimeout(600);
    await page.locator("#stop").waitFor({ state: "hidden" });
    await close();
  },
};
