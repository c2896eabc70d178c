// How the page behaves: keys, labels, panes, a phone, texts of strangers; the same over each back end.
import assert from "node:assert/strict";
import { addFile, begin, faults, openFile, said, typeAtTop } from "./steps.mjs";

export const behaving = {
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
    // The path can be looked at, played, and clicked.
    await page.locator("#views button", { hasText: "Findings" }).click();
    await page.getByRole("tab", { name: "Path" }).click();
    await page.locator(".fv-legend label", { hasText: "feed" }).waitFor();
    await page.getByRole("button", { name: "One motion back" }).click();
    const canvas = await page.locator("#view canvas").boundingBox();
    assert.ok(canvas.width > 300 && canvas.height > 200, JSON.stringify(canvas));
    await picture("phone-path");
    assert.deepEqual(await faults(page), []);
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
    // Names of files too: of the part, of a script, of the program that is laid under the own one.
    for (const [end, text] of [["ncl", "UNITS / MM\nLOADTL / 1\nBAD\nFINI\n"], ["fil", "XX = SQRTFF(4)\n"], ["nc", "G1 X5. F100\nM30\n"]]) {
      await addFile(page, `<img src=x onerror='window.hurt=3'>-${end}.${end}`, text);
    }
    await page.getByRole("tab", { name: "Path" }).click();
    await page.locator("#second").selectOption({ label: "<img src=x onerror='window.hurt=3'>-nc.nc" });
    await page.locator("#dialog", { hasText: "-nc.nc can't be shown" }).locator(".close").click();
    await page.click("#tab-cases");
    await page.waitForTimeout(300);
    assert.equal(await page.evaluate(() => window.hurt), undefined);
    await close();
  },
};
