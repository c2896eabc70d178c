// What a person does in the playground, which has no server.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { strFromU8, unzipSync } from "fflate";
import { examples } from "../../../../docs/playground/examples.mjs";

const corpus = join(dirname(fileURLToPath(import.meta.url)), "../../../../corpus");
const said = (page, text) => page.locator("#status", { hasText: text }).waitFor({ timeout: 30_000 });
const plain = (text) => text.replaceAll("\r\n", "\n");
const program = (page) => page.evaluate(() => globalThis.filpost.program());

export const alone = {
  async "every example gives the program of its case"(studio) {
    const { page, close } = await studio();
    for (const { title, expected } of examples(corpus)) {
      await said(page, /blocks|Refused/);
      await page.click("#start");
      await page.evaluate(() => (document.getElementById("status").textContent = ""));
      await page.locator(".card", { has: page.getByText(title, { exact: true }) }).click();
      await said(page, expected === null ? "Refused" : "blocks").catch(async (error) => {
        throw new Error(`${title}: ${await page.locator("#status").innerText()}, ${await page.locator("#findings").innerText()}`, { cause: error });
      });
      // An editor has one kind of line end.
      assert.equal(plain(await program(page)), plain(expected ?? ""), title);
    }
    await close();
  },

  async "a link brings all files along"(studio) {
    const { page, close } = await studio();
    await said(page, "blocks");
    const before = await program(page);
    await page.click("#share");
    await page.locator("#dialog", { hasText: "Shared" }).waitFor();
    const hash = await page.evaluate(() => location.hash);
    await close();
    const other = await studio({ hash });
    await said(other.page, "blocks");
    assert.equal(await program(other.page), before);
    await other.close();
    const broken = await studio({ hash: hash.slice(0, 40) });
    await broken.page.locator("#dialog", { hasText: "can't be read" }).waitFor();
    await said(broken.page, "blocks");
    await broken.close();
  },

  async "files are dropped, and make a post of their own"(studio) {
    const { page, read, close } = await studio();
    await said(page, "blocks");
    await page.evaluate(() => globalThis.filpost.empty());
    await page.locator(".card", { has: page.getByText("fanuc-mill", { exact: true }) }).click();
    await said(page, "blocks");
    const cl = "UNITS / MM\nLOADTL / 7\nSPINDL / 900, RPM, CLW\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";
    const files = await page.evaluateHandle((text) => {
      const list = new DataTransfer();
      list.items.add(new File([text], "dropped.ncl"));
      list.items.add(new File(["$$ nothing\n"], "other.fil"));
      return list;
    }, cl);
    await page.dispatchEvent("main", "drop", { dataTransfer: files });
    await page.locator("#nc .cm-content", { hasText: "S900 M3" }).waitFor();
    assert.equal(await read("dropped.ncl"), cl);
    assert.equal(await page.locator("#part").inputValue(), "dropped.ncl");
    await close();
  },

  async "all files are downloaded in one archive"(studio) {
    const { page, close } = await studio();
    await said(page, "blocks");
    const [file] = await Promise.all([page.waitForEvent("download"), page.click("#download")]);
    assert.equal(file.suggestedFilename(), "post.zip");
    const packed = unzipSync(readFileSync(await file.path()));
    assert.equal(strFromU8(packed["program.nc"]), await program(page));
    assert.equal(strFromU8(packed["machine.toml"]), await page.evaluate(() => globalThis.filpost.text("machine.toml")));
    await close();
  },

  async "a post word tells its forms, and proposals come"(studio) {
    const { page, close } = await studio();
    await said(page, "blocks");
    const editor = page.locator("#editors .editor:visible");
    await editor.locator(".cm-content").click();
    await page.keyboard.press("Control+Home");
    await page.keyboard.insertText("SPINDL/OFF\n");
    await page.keyboard.press("Control+Home");
    await page.locator("#word", { hasText: "SPINDL/RPM" }).waitFor();
    await page.keyboard.type("XX=SQR");
    await page.locator(".cm-tooltip-autocomplete", { hasText: "SQRTF" }).waitFor({ timeout: 10_000 });
    await close();
  },

  async "a loop without end is refused, and the page goes on"(studio) {
    const { page, close } = await studio();
    await said(page, "blocks");
    await page.locator("#editors .editor:visible .cm-content").click();
    await page.keyboard.press("Control+Home");
    await page.keyboard.insertText("AGAIN) CONTIN\nJUMPTO/AGAIN\n");
    await said(page, "Refused");
    await page.locator("#findings li", { hasText: "E0304" }).waitFor();
    await page.keyboard.press("Control+z");
    await said(page, "blocks");
    await close();
  },
};
