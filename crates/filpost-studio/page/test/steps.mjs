// What the tests do in a page, step by step.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

export const said = (page, text) => page.locator("#status", { hasText: text }).waitFor({ timeout: 15_000 });
export const nc = (page) => page.locator("#nc .cm-content").innerText();

/** Begins a post from a ready one. An empty folder asks by itself; the playground has an example. */
export async function begin(page, ready) {
  if ((await page.locator("#place").innerText()) === "playground") {
    await said(page, /blocks|Refused/);
    await page.evaluate(() => globalThis.filpost.empty());
  }
  await page.locator(".card", { has: page.getByText(ready, { exact: true }) }).click();
  await said(page, "blocks");
}

/** Adds a file to the post. */
export async function addFile(page, name, text) {
  const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.click("#add")]);
  await chooser.setFiles({ name, mimeType: "text/plain", buffer: Buffer.from(text) });
  await page.locator("#tree .name", { hasText: name }).waitFor();
}

/** Types text at the start of the file that is shown. */
export async function typeAtTop(page, text) {
  await page.locator("#editors .editor:visible .cm-content").click();
  await page.keyboard.press("Control+Home");
  await page.keyboard.insertText(text);
}

/** The row of a setting in the form. */
export const setting = (page, key) => page.locator(`[id="set-${key}"]`);

/** Waits until the program has a text. */
export async function shows(page, text) {
  await page.locator("#nc .cm-content", { hasText: text }).waitFor({ timeout: 15_000 });
}

/** A box as binary STL, from corner to corner. */
export function binaryBox(low, high) {
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
export async function faults(page) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => globalThis.axe.run(document, {
    runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"],
    // It would ask for the style sheets, which a page from a disk may not.
    preload: false,
  }));
  return violations.map(({ id, nodes }) => `${id}: ${nodes.slice(0, 3).map((node) => node.html.slice(0, 160)).join(" | ")}`);
}

export const openFile = (page, name) => page.locator(`#tree .name[title="${name}"]`).click();
