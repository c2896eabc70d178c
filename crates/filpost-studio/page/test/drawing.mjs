// What a person does with the path in three dimensions; the same over each back end.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { addFile, begin, faults } from "./steps.mjs";

const corpus = join(dirname(fileURLToPath(import.meta.url)), "../../../../corpus/posts");

/** Opens the tab, and waits for the path. */
async function openPath(page) {
  await page.getByRole("tab", { name: "Path" }).click();
  await page.locator(".fv-legend label", { hasText: "feed" }).waitFor();
}

export const drawing = {
  async "a block shows its motions, and a motion its block"(studio) {
    const { page, picture, close } = await studio();
    await begin(page, "haas-mill");
    await openPath(page);
    const line = page.locator("#nc .cm-line", { hasText: "X40." }), text = (await line.innerText()).trim();
    await line.click();
    await page.locator(".fv-block", { hasText: text }).waitFor();
    await picture("path");
    // From above the first cut crosses the middle of the picture's left half: a click on it leads to its block and record.
    await page.getByRole("button", { name: "Top", exact: true }).click();
    await page.getByRole("button", { name: "Fit", exact: true }).click();
    const cause = page.locator("#cause"), before = await cause.innerText();
    const { x, y, width, height } = await page.locator("#view canvas").boundingBox();
    for (let down = height - 12; down > 12 && (await cause.innerText()) === before; down -= 6) {
      await page.mouse.click(x + width / 2, y + down);
    }
    const block = /N\d+.*/.exec(await page.locator("#nc .cm-activeLine").innerText())?.[0];
    await page.locator(".fv-block", { hasText: block }).waitFor();
    await cause.locator("button", { hasText: /part\.ncl:\d+.*GOTO/s }).click();
    await page.locator("#open-tabs [aria-selected=true]", { hasText: "part.ncl" }).waitFor();
    // Played, with what is in force.
    await page.getByRole("button", { name: "Play", exact: true }).click();
    await page.locator(".fv-state", { hasText: /T1 .*F 300 mm\/min.*S 2000 rpm/ }).waitFor();
    await close();
  },

  async "a second program lies under the own one, with what is left out"(studio) {
    const { page, picture, close } = await studio();
    await begin(page, "haas-mill");
    await openPath(page);
    const second = page.locator("#second");
    await second.selectOption({ label: "cases/first/part.ncl" });
    await page.locator(".fv-legend label", { hasText: "part.ncl" }).waitFor();
    await picture("path-over-cl");
    // Why a program has no path is said.
    await addFile(page, "broken.nc", "G90 G54 G0 X0. Y0.\nG1 X5. F\n");
    await second.selectOption({ label: "broken.nc" });
    await page.locator("#dialog", { hasText: /line 2: E0902/ }).locator(".close").click();
    // A program with a word that the machine lacks is drawn as far as it goes.
    await addFile(page, "other.nc", "%\nO1\nG90 G54 G0 X0. Y0.\nG1 Z-1. F100.\nX20.\nG5.1 Q1 X25.\nG1 X30. Y0.\nY20.\nM30\n%\n");
    await second.selectOption({ label: "other.nc" });
    await page.locator(".fv-missing summary", { hasText: /gap/ }).click();
    await page.locator(".fv-missing p", { hasText: /other\.nc.*line 6/ }).waitFor();
    await page.locator(".fv-legend label", { hasText: "other.nc" }).waitFor();
    await picture("path-gaps");
    assert.deepEqual(await faults(page), [], "the path");
    await close();
  },

  async "a given tool has its holder"(studio) {
    const { page, picture, close } = await studio();
    await begin(page, "haas-mill");
    await page.click("#tab-stock");
    const tools = page.locator("#stock-form").getByLabel("Tools");
    await tools.fill("1 = D12L30H40x60H63x20");
    await tools.press("Tab");
    await openPath(page);
    await page.locator(".fv-state", { hasText: "T1 flat ⌀12" }).waitFor();
    await picture("path-holder");
    await close();
  },

  async "a table turns the part, and a lathe lies"(studio) {
    const five = await studio();
    await begin(five.page, "haas-trunnion");
    await addFile(five.page, "five.ncl", readFileSync(join(corpus, "cl/five-faces.ncl"), "utf8"));
    await openPath(five.page);
    await five.page.locator(".fv-state", { hasText: /[ABC]-?\d/ }).waitFor();
    await five.page.getByRole("button", { name: "Machine", exact: true }).click();
    await five.page.locator(".fv button[aria-pressed=true]", { hasText: "Machine" }).waitFor();
    await five.picture("path-table");
    await five.close();
    const lathe = await studio();
    await begin(lathe.page, "fanuc-lathe");
    await openPath(lathe.page);
    await lathe.page.locator(".fv-state", { hasText: /⌀[\d.]+ Z/ }).waitFor();
    await lathe.picture("path-lathe");
    await lathe.close();
  },
};
