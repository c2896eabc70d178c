// Uses the extension in VS Code itself: code-server in a headless chromium, as a person does.
// Arguments: the folder with the tools, the command, the extension, a folder with a case, an
// empty folder, a folder for pictures.
const assert = require('assert');
const { execFileSync, spawn } = require('child_process');
const fs = require('fs');
const net = require('net');
const path = require('path');
const { chromium } = require('playwright-core');

const [tools, command, extension, workspace, empty, pictures] = process.argv.slice(2);
const server = path.join(tools, 'bin', 'code-server');
const LONG = 60000;

function freePort() {
  return new Promise((resolve) => {
    const listener = net.createServer().listen(0, '127.0.0.1', () => {
      const { port } = listener.address();
      listener.close(() => resolve(port));
    });
  });
}

/** Starts the editor with the extension in it; gives its process and address. */
async function start() {
  const home = fs.mkdtempSync(path.join(require('os').tmpdir(), 'filpost-vscode-'));
  const own = ['--user-data-dir', path.join(home, 'data'), '--extensions-dir', path.join(home, 'extensions')];
  const settings = (folder, values) => {
    fs.mkdirSync(path.join(home, 'data', folder), { recursive: true });
    fs.writeFileSync(path.join(home, 'data', folder, 'settings.json'), JSON.stringify(values));
  };
  // A setting that names a command is one of the machine that the server runs on.
  settings('Machine', { 'filpost.command': command });
  settings('User', {
    'workbench.startupEditor': 'none',
    'workbench.colorTheme': 'Default Light Modern',
    'editor.minimap.enabled': false,
    'window.commandCenter': false,
    'workbench.secondarySideBar.defaultVisibility': 'hidden',
    'chat.disableAIFeatures': true,
    'files.autoSave': 'off',
    'debug.toolBarLocation': 'docked',
    'debug.internalConsoleOptions': 'neverOpen',
    'testing.automaticallyOpenTestResults': 'neverOpen',
    'git.enabled': false,
    'window.restoreWindows': 'none',
  });
  const env = { ...process.env, HOME: home };
  execFileSync(server, [...own, '--install-extension', extension], { env, stdio: 'pipe' });
  const port = await freePort();
  const quiet = ['--auth', 'none', '--disable-telemetry', '--disable-update-check', '--disable-workspace-trust'];
  const child = spawn(server, [...own, ...quiet, '--bind-addr', `127.0.0.1:${port}`], { env, stdio: 'pipe', detached: true });
  await new Promise((resolve, reject) => {
    child.on('exit', () => reject(new Error('code-server ended')));
    child.stdout.on('data', (said) => String(said).includes('listening') && resolve());
    child.stderr.on('data', () => {});
    setTimeout(resolve, 20000);
  });
  return { child, home, url: (folder) => `http://127.0.0.1:${port}/?folder=${encodeURIComponent(folder)}` };
}

/** VS Code in a page. */
class Editor {
  constructor(page) {
    this.page = page;
  }

  /** Takes what the quick input proposes. */
  async enter() {
    await this.page.keyboard.press('Enter');
    await this.page.locator('.quick-input-widget').first().waitFor({ state: 'hidden' });
  }

  async command(name) {
    await this.page.keyboard.press('F1');
    await this.page.locator('.quick-input-widget input').first().waitFor({ state: 'visible' });
    await this.page.keyboard.type(name);
    await this.page.locator('.quick-input-list .monaco-list-row', { hasText: name }).first().waitFor();
    await this.enter();
  }

  async open(file) {
    const tab = this.page.locator('.tab.active', { hasText: path.basename(file) }).first();
    // The list may still be that of the files before the name was typed: then it is asked again.
    for (let left = 4; ; left -= 1) {
      await this.page.keyboard.press('Control+P');
      await this.page.locator('.quick-input-widget input').first().waitFor({ state: 'visible' });
      await this.page.keyboard.type(file);
      await this.page.locator('.quick-input-list .monaco-list-row', { hasText: path.basename(file) }).first().waitFor();
      await this.enter();
      if (await tab.waitFor({ timeout: 10000 }).then(() => true, () => false)) {
        break;
      }
      assert(left > 0, `${file} is not opened`);
    }
    await this.page.locator('.editor-group-container.active .view-line').first().waitFor();
  }

  /** Sets the cursor to a line and column, 1-based. */
  async goto(line, column = 1) {
    await this.page.keyboard.press('Control+G');
    await this.page.locator('.quick-input-widget input').first().waitFor({ state: 'visible' });
    await this.page.keyboard.type(`${line}:${column}`);
    await this.enter();
  }

  /** Presses a key until something is seen: the editor may still be at what came before. */
  async until(key, seen) {
    for (const began = Date.now(); Date.now() - began < LONG;) {
      await this.page.keyboard.press(key);
      if (await seen.waitFor({ timeout: 5000 }).then(() => true, () => false)) {
        return;
      }
    }
    throw new Error(`${key} shows nothing`);
  }

  async save() {
    await this.page.keyboard.press('Control+S');
    await this.page.waitForTimeout(500);
  }

  /** The editors whose active tab has a name. */
  group(tab) {
    const active = this.page.locator('.tab.active', { hasText: tab });
    return this.page.locator('.editor-group-container', { has: active });
  }

  /** A line of text there. Blanks of an editor are not those of a text. */
  line(tab, text) {
    const words = text.split(' ').map((word) => word.replace(/[.*+?^${}()|[\]\\]/g, '\\$&'));
    return this.group(tab).locator('.view-line', { hasText: new RegExp(words.join('\\s')) }).first();
  }

  /** Waits until a line of text is marked: as the one that made, or was made by, what was clicked. */
  async marked(tab, text) {
    const line = await this.line(tab, text).evaluate((node) => node.style.top);
    const marks = this.group(tab).locator('.view-overlays > div', { has: this.page.locator('.cdr') });
    for (const began = Date.now(); Date.now() - began < LONG; await this.page.waitForTimeout(100)) {
      const tops = await marks.evaluateAll((nodes) => nodes.map((node) => node.style.top));
      const now = await this.line(tab, text).evaluate((node) => node.style.top);
      if (tops.includes(now)) {
        return;
      }
    }
    throw new Error(`${tab}: "${text}" is not marked (${line})`);
  }

  /** Waits until the cursor is in a line. */
  async isAt(line) {
    const place = this.page.locator('.statusbar-item', { hasText: new RegExp(`Ln ${line},`) });
    await place.first().waitFor({ timeout: LONG });
  }

  async picture(name) {
    await this.page.screenshot({ path: path.join(pictures, `vscode-${name}.png`) });
  }
}

const read = (name) => fs.readFileSync(path.join(workspace, name), 'utf8');
const lineOf = (name, text) => 1 + read(name).split('\n').findIndex((line) => line.includes(text));

/** A word that nobody knows is found and repaired by its action. */
async function diagnostic(editor) {
  const { page } = editor;
  await editor.open('mill.fil');
  await editor.goto(lineOf('mill.fil', 'FIRST = 1'), 20);
  await page.keyboard.press('End');
  await page.keyboard.press('Enter');
  await page.keyboard.type('SPINDEL/ON');
  await page.locator('.squiggly-warning, .squiggly-error').first().waitFor({ timeout: LONG });
  await editor.command('Problems: Focus on Problems View');
  await page.locator('.markers-panel', { hasText: 'did you mean SPINDL' }).first().waitFor({ timeout: LONG });
  await editor.picture('diagnostic');
  await editor.open('mill.fil');
  await editor.goto(lineOf('mill.fil', 'FIRST = 1') + 1, 3);
  await editor.until('Control+.', page.locator('.action-widget', { hasText: 'write SPINDL' }).first());
  await page.keyboard.press('Enter');
  await editor.line('mill.fil', 'SPINDL/ON').waitFor({ timeout: LONG });
  // Away with the list of problems.
  await page.keyboard.press('Control+J');
}

/** A minor word of CYCLE is proposed and taken. */
async function completion(editor) {
  const { page } = editor;
  await editor.open('mill.fil');
  await editor.goto(lineOf('mill.fil', 'FIRST = 1') + 1, 1);
  await page.keyboard.press('Shift+End');
  await page.keyboard.type('CIMFIL/ON,CYCLE,DRI', { delay: 30 });
  const proposed = page.locator('.suggest-widget .monaco-list-row', { hasText: 'DRILL' }).first();
  await proposed.waitFor({ timeout: LONG });
  await editor.picture('completion');
  await page.keyboard.press('Tab');
  await editor.line('mill.fil', 'CIMFIL/ON,CYCLE,DRILL').waitFor({ timeout: LONG });
  // Back to the text as it was saved.
  await editor.command('File: Revert File');
  await page.waitForTimeout(500);
}

/** A breakpoint on a line of FIL stops, and a name has its value. */
async function breakpoint(editor) {
  const { page } = editor;
  await editor.open('mill.fil');
  await editor.goto(lineOf('mill.fil', 'IF (FIRST.EQ.0) THEN'));
  await page.keyboard.press('F9');
  await page.locator('.codicon-debug-breakpoint').first().waitFor({ timeout: LONG });
  await page.keyboard.press('F5');
  await page.locator('.debug-top-stack-frame-line').first().waitFor({ timeout: LONG });
  const names = page.locator('.debug-view-content .monaco-list-row', { hasText: 'Names' }).first();
  await names.waitFor({ timeout: LONG });
  await page.waitForTimeout(1000);
  if ((await names.getAttribute('aria-expanded')) !== 'true') {
    await names.click();
    await page.keyboard.press('ArrowRight');
  }
  const tool = page.locator('.debug-view-content .monaco-list-row', { hasText: 'NUM' }).first();
  await tool.waitFor({ timeout: LONG });
  const shown = (await tool.innerText()).replace(/\s+/g, ' ');
  assert.match(shown, /NUM ?[:=] ?1/, shown);
  await editor.picture('debugger');
  await page.keyboard.press('Shift+F5');
  await page.locator('.debug-toolbar').first().waitFor({ state: 'hidden', timeout: LONG }).catch(() => {});
  await editor.command('Remove All Breakpoints');
  await editor.command('View: Show Explorer');
}

/** The program beside: a click leads to the line of FIL, one in FIL back, and a change shows at once. */
async function preview(editor) {
  const { page } = editor;
  await editor.open('mill.fil');
  await editor.command('filpost: Show the NC program beside');
  const block = editor.line('(posted).nc', '(END MILL 12)');
  await block.waitFor({ timeout: LONG });
  await block.click();
  const wanted = lineOf('mill.fil', 'PPRINT END MILL 12');
  const marked = editor.group('mill.fil').locator('.view-overlays > div', { has: page.locator('.cdr') });
  await marked.first().waitFor({ timeout: LONG });
  await editor.picture('preview');
  // And with the cursor in the line, the command goes to the line of FIL.
  await editor.command('filpost: Go to the line of FIL');
  await editor.isAt(wanted);
  // A change that is not saved shows at once; one that is refused leaves no program behind.
  await page.keyboard.press('End');
  await page.keyboard.type(', 4 FLUTES');
  await editor.line('(posted).nc', '(END MILL 12, 4 FLUTES)').waitFor({ timeout: LONG });
  await editor.goto(wanted + 1);
  await page.keyboard.press('Shift+End');
  await page.keyboard.type('IF(');
  await editor.line('(posted).nc', 'refused, no program').waitFor({ timeout: LONG });
  await editor.command('File: Revert File');
  await block.waitFor({ timeout: LONG });
  // A click in FIL shows the lines that it made.
  await editor.line('mill.fil', 'PPRINT DRILL 5').click();
  await editor.group('(posted).nc').locator('.cdr').first().waitFor({ timeout: LONG });
  await records(editor);
}

/** From a block to its CL record by the command and by a click, and from a record to its blocks. */
async function records(editor) {
  const { page } = editor;
  await editor.line('(posted).nc', 'N45 X40.').click();
  await editor.command('filpost: Go to the CL record');
  await page.locator('.tab.active', { hasText: 'plate.ncl' }).first().waitFor({ timeout: LONG });
  await editor.isAt(lineOf('plate.ncl', 'GOTO / 40.'));
  // With the CL file in view a click shows the record there, and one in the record its block.
  await editor.line('(posted).nc', 'N95 G43 Z20. H2').click();
  await editor.marked('plate.ncl', 'GOTO / 10.0000000000, 10.0000000000, 20.');
  await editor.line('plate.ncl', 'GOTO / 30.').click();
  await editor.marked('(posted).nc', 'N105 X30.');
  await editor.picture('records');
  await page.locator('.tab', { hasText: 'mill.fil' }).first().click();
}

/** The path beside, and the machine as a form whose change is an edit of machine.toml. */
async function panels(editor) {
  const { page } = editor;
  await editor.open('mill.fil');
  await editor.command('filpost: Show the plot beside');
  const plot = page.frameLocator('iframe.webview').last().frameLocator('iframe').first();
  await plot.locator('svg, canvas').first().waitFor({ timeout: LONG });
  // A line of the program in the plot leads to what made it.
  await plot.locator('#rows [data-line]', { hasText: '(DRILL 5)' }).first().click({ timeout: LONG });
  await editor.marked('mill.fil', 'PPRINT DRILL 5');
  await page.keyboard.press('Control+B');
  await page.waitForTimeout(1000);
  await editor.picture('plot');
  await page.keyboard.press('Control+B');
  await editor.command('View: Close All Editors');
  await editor.open('machine.toml');
  await editor.command('filpost: Settings of this machine as a form');
  const form = page.frameLocator('iframe.webview').last().frameLocator('iframe').first();
  await form.locator('[data-key="seqno.increment"] input').waitFor({ timeout: LONG });
  await form.locator('#search').fill('seqno');
  await form.locator('[data-key="seqno.increment"] input').fill('20');
  await form.locator('[data-key="seqno.increment"] input').press('Tab');
  await editor.line('machine.toml', 'increment = 20').waitFor({ timeout: LONG });
  await form.locator('[data-key="seqno.off_at_start"] select').selectOption('72');
  await editor.line('machine.toml', 'off_at_start = 72').waitFor({ timeout: LONG });
  await editor.picture('settings');
  await form.locator('[data-key="seqno.every"] input').fill('often');
  await form.locator('[data-key="seqno.every"] input').press('Tab');
  await form.locator('[data-key="seqno.every"] .wrong:not(:empty)').waitFor({ timeout: LONG });
  await editor.line('machine.toml', 'increment = 20').click();
  await editor.command('File: Revert File');
  await editor.command('View: Close All Editors');
}

/** The case passes in the test explorer. */
async function cases(editor) {
  const { page } = editor;
  await editor.command('Testing: Focus on Test Explorer View');
  const test = page.locator('.test-explorer .monaco-list-row', { hasText: path.basename(workspace) }).first();
  await test.waitFor({ timeout: LONG });
  await editor.command('Test: Run All Tests');
  await page.locator('.test-explorer .codicon-testing-passed-icon').first().waitFor({ timeout: LONG });
  await editor.picture('cases');
}

/** The page of the docs: from an empty folder to a section that works. */
async function fromNothing(editor) {
  const { page } = editor;
  const below = (name) => fs.readFileSync(path.join(empty, name), 'utf8');
  await editor.command('filpost: New post');
  const input = page.locator('.quick-input-widget input').first();
  await input.waitFor({ state: 'visible', timeout: LONG });
  await page.keyboard.type('mymill');
  await page.keyboard.press('Enter');
  await page.locator('.quick-input-list .monaco-list-row', { hasText: 'fanuc-mill' }).first().waitFor({ timeout: LONG });
  await page.keyboard.type('fanuc-mill');
  await editor.enter();
  await page.locator('.tab.active', { hasText: 'post.fil' }).first().waitFor({ timeout: LONG });
  await editor.command('filpost: Show the NC program beside');
  await editor.line('(posted).nc', 'M8').waitFor({ timeout: LONG });
  const script = path.join('mymill', 'post.fil');
  const fini = below(script).split('\n').lastIndexOf('FINI') + 1;
  await editor.group('post.fil').locator('.view-line').first().click();
  await editor.goto(fini);
  for (const text of ['CIMFIL/ON,COOLNT', '  PPRINT COOLANT CHANGES', 'DMY = POSTF(13)', 'CIMFIL/OFF']) {
    await page.keyboard.press('Home');
    await page.keyboard.press('Shift+End');
    await page.keyboard.type(`${text.trim()} `);
    await page.keyboard.press('Backspace');
    await page.keyboard.press('Escape');
    await page.keyboard.press('Enter');
  }
  await page.keyboard.type('FINI');
  await page.keyboard.press('Escape');
  await editor.line('(posted).nc', '(COOLANT CHANGES)').waitFor({ timeout: LONG });
  await editor.save();
  // Its breakpoint stops.
  const stop = below(script).split('\n').lastIndexOf('DMY = POSTF(13)') + 1 || below(script).split('\n').findLastIndex((line) => line.includes('POSTF(13)')) + 1;
  await editor.goto(stop);
  await page.keyboard.press('F9');
  await page.keyboard.press('F5');
  await page.locator('.debug-top-stack-frame-line').first().waitFor({ timeout: LONG });
  await page.locator('.debug-call-stack', { hasText: 'section COOLNT' }).first().waitFor({ timeout: LONG });
  await page.keyboard.press('Shift+F5');
  // The case notices the change, and takes it.
  await editor.command('Testing: Focus on Test Explorer View');
  await page.locator('.test-explorer .monaco-list-row', { hasText: 'first' }).first().waitFor({ timeout: LONG });
  await editor.command('Test: Run All Tests');
  await page.locator('.test-explorer .codicon-testing-failed-icon').first().waitFor({ timeout: LONG });
  await editor.line('post.fil', 'PPRINT COOLANT CHANGES').click();
  await editor.command('filpost: Take the new program as the expected one');
  await page.waitForTimeout(1500);
  await editor.command('Test: Run All Tests');
  await page.locator('.test-explorer .codicon-testing-passed-icon').first().waitFor({ timeout: LONG });
  assert.match(below(path.join('mymill', 'cases', 'first', 'expected.nc')), /COOLANT CHANGES/);
}

async function main() {
  const { child, home, url } = await start();
  let page;
  let browser;
  try {
    const executablePath = process.env.FILPOST_CHROMIUM;
    browser = await chromium.launch({ executablePath, args: ['--no-sandbox'] });
    for (const [folder, steps] of [
      [workspace, [diagnostic, completion, breakpoint, preview, panels, cases]],
      [empty, [fromNothing]],
    ]) {
      page = await browser.newPage({ viewport: { width: 1280, height: 760 } });
      await page.goto(url(folder));
      await page.locator('.monaco-workbench').waitFor({ timeout: LONG });
      await page.waitForTimeout(3000);
      const editor = new Editor(page);
      for (const step of steps) {
        const began = Date.now();
        await step(editor);
        console.log(`${step.name}: ${Date.now() - began} ms`);
      }
      await page.close();
    }
    console.log('all steps passed');
  } catch (error) {
    await page?.screenshot({ path: path.join(pictures, 'vscode-failed.png') });
    throw error;
  } finally {
    await browser?.close();
    process.kill(-child.pid);
    fs.rmSync(home, { recursive: true, force: true });
  }
}

main().catch((error) => {
  console.error(error);
  process.exit(1);
});
