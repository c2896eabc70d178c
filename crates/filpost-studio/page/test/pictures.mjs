// Takes the pictures of the book: node pictures.mjs FILPOST FILPOST-STUDIO CHROMIUM DOCS. It does in the browser what
// docs/studio-tutorial.md tells, with the part of corpus/tutorial, so each picture shows the page as it is.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [filpost, studio, executablePath, docs] = process.argv.slice(2).map((path) => resolve(path));
const tutorial = resolve(dirname(fileURLToPath(import.meta.url)), "../../../../corpus/tutorial");
const top = mkdtempSync(join(tmpdir(), "pictures-"));
const args = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-first-run"];
const browser = await chromium.launch({ executablePath, args });
const page = await browser.newPage({ viewport: { width: 1280, height: 760 } });
const said = (text) => page.locator("#status", { hasText: text }).waitFor({ timeout: 30_000 });
const take = async (name) => {
  await page.mouse.move(4, 4);
  await page.waitForTimeout(400);
  await page.screenshot({ path: join(docs, `${name}.png`) });
};

// A post from a ready one, with the part of the tutorial.
const server = spawn(studio, ["--no-open", join(top, "my-post")], { stdio: ["ignore", "pipe", "inherit"] });
const address = await new Promise((found) => server.stdout.once("data", (line) => found(String(line).trim())));
await page.goto(address);
await page.locator(".card", { has: page.getByText("haas-mill", { exact: true }) }).waitFor();
await take("studio-begin");
await page.locator(".card", { has: page.getByText("haas-mill", { exact: true }) }).click();
await said("blocks");
const chosen = page.waitForEvent("filechooser");
await page.locator("#add").click();
await (await chosen).setFiles([join(tutorial, "plate.ncl")]);
await page.locator("#part option", { hasText: "plate.ncl" }).waitFor({ state: "attached" });
await page.locator("#part").selectOption("plate.ncl");
await page.locator("#nc .cm-content", { hasText: "G3 X50. Y10." }).waitFor();

// A setting in the form.
await page.locator("#open-tabs [role=tab]", { hasText: "Machine" }).click();
await page.locator('[id="set-seqno.increment"]').fill("5");
await page.locator('[id="set-seqno.increment"]').press("Enter");
await page.locator("#nc .cm-content", { hasText: "N15 G53" }).waitFor();
await page.locator("#cause", { hasText: "The last change" }).waitFor();
await take("studio-machine");

// A section, and the records that it takes.
await page.locator('#tree .name[title="post.fil"]').click();
await page.locator("#editors .editor:visible .cm-content").click();
await page.keyboard.press("Control+Home");
await page.keyboard.insertText("$$ A message before deep holes.\nCIMFIL/ON,CYCLE,DEEP\n  PPRINT DEEP HOLES\n  DMY = POSTF(13)\nCIMFIL/OFF\n\n");
const message = page.locator("#nc .cm-line", { hasText: "DEEP HOLES" }).first();
await page.locator("#nc .cm-scroller").evaluate((scroller) => scroller.scrollTo(0, scroller.scrollHeight));
await message.click();
await page.locator("#cause button", { hasText: "PPRINT DEEP HOLES" }).first().click();
await take("studio-cause");

// What is wrong is found, with a repair.
await page.locator("#editors .editor:visible .cm-content").click();
await page.keyboard.press("Control+Home");
await page.keyboard.insertText("XX = SQRTFF(4)\n");
await said("Refused");
await page.locator("#findings .repair").first().waitFor();
await take("studio-refused");
await page.locator("#findings .repair").first().click();
await said("blocks");
await page.locator("#editors .editor:visible .cm-content").click();
await page.keyboard.press("Control+Home");
await page.keyboard.press("Shift+ArrowDown");
await page.keyboard.press("Delete");
await said("blocks");

// The path, with a block chosen.
await page.locator("#tab-path").click();
await page.locator("#view canvas").first().waitFor();
await page.locator("#nc .cm-line", { hasText: "G3 X50." }).first().click();
await page.waitForTimeout(1500);
await take("studio");

// Over the path of its CL file, with the tool on its way.
await page.locator("#second").selectOption({ label: "plate.ncl" });
await page.locator(".fv-legend label", { hasText: "plate.ncl" }).waitFor();
for (let step = 0; step < 2; step++) await page.getByRole("button", { name: "One motion back" }).click();
await page.waitForTimeout(600);
await take("studio-path");
await page.keyboard.press("Control+s");
await page.waitForFunction(() => !document.querySelector("#tree .dirty"));

// The page of `filpost plot`.
const run = (...words) => execFileSync(filpost, words, { cwd: top, stdio: "ignore" });
const cl = join(tutorial, "plate.ncl");
run("post", cl, "-p", "haas-mill", "-o", "plate.nc");
run("plot", "plate.nc", "-p", "haas-mill", "--cl", cl, "-o", "plate.html");
await page.goto(pathToFileURL(join(top, "plate.html")).href);
await page.waitForTimeout(800);
await page.screenshot({ path: join(docs, "plot-page.png") });
await browser.close();
const status = await new Promise((over) => (server.exitCode === null ? server.on("exit", over) : over(server.exitCode)));
assert.equal(status, 0, "the studio ends with its page");
rmSync(top, { recursive: true });
