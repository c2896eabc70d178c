// What a person does in the studio; the same over each back end.
import assert from "node:assert/strict";

const said = (page, text) => page.locator("#status", { hasText: text }).waitFor({ timeout: 15_000 });
const nc = (page) => page.locator("#nc .cm-content").innerText();

/** Begins a post from a ready one, in an empty folder. */
async function begin(page, ready) {
  await page.locator(".card", { has: page.getByText(ready, { exact: true }) }).click();
  await said(page, "blocks");
}

/** Types text at the start of the file that is shown. */
async function typeAtTop(page, text) {
  await page.locator("#editors .editor:visible .cm-content").click();
  await page.keyboard.press("Control+Home");
  await page.keyboard.insertText(text);
}

const openFile = (page, name) => page.locator(`#tree .name[title="${name}"]`).click();

export const tests = {
  async "from an empty folder to a saved post"(studio) {
    const { page, read, picture, close } = await studio();
    await picture("begin");
    await begin(page, "haas-mill");
    assert.match(await nc(page), /G43 Z50\. H1/);
    await page.keyboard.press("Control+s");
    await page.locator("#save:disabled").waitFor();
    assert.match(read("machine.toml"), /base = "haas-mill"/);
    assert.match(read("cases/first/expected.nc"), /M30/);
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
