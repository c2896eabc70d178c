// Uses Neovim, Emacs and Helix in a terminal, each with the configuration that its page in the docs has.
// Arguments: the folder with the tools, the command, the repository, a folder with a case, a folder for
// pictures, the editors. Pictures are made where playwright and a chromium are there.
const { execFileSync } = require('child_process');
const fs = require('fs');
const path = require('path');

const [tools, command, repository, workspace, pictures, ...editors] = process.argv.slice(2);
const LONG = 60000;
const SIZE = { columns: 100, rows: 28 };
const home = fs.mkdtempSync(path.join(require('os').tmpdir(), 'filpost-terminal-'));
const socket = path.join(home, 'tmux');

/** The n-th block of code of a page. */
function recipe(page, language) {
  const text = fs.readFileSync(path.join(repository, 'docs/editors', page), 'utf8');
  const found = new RegExp('```' + language + '\\n([^]*?)```').exec(text);
  return found[1];
}

function write(name, text) {
  const file = path.join(home, name);
  fs.mkdirSync(path.dirname(file), { recursive: true });
  fs.writeFileSync(file, text);
}

function tmux(...args) {
  return execFileSync('tmux', ['-S', socket, ...args], { encoding: 'utf8', env: { ...process.env, TMUX: '' } });
}

const keys = (...names) => tmux('send-keys', '-t', 'editor', ...names);
const type = (text) => tmux('send-keys', '-t', 'editor', '-l', text);
const screen = () => tmux('capture-pane', '-p', '-t', 'editor');
const pause = (time) => new Promise((resolve) => setTimeout(resolve, time));

/** Waits until the screen shows a text. */
async function shows(text) {
  for (const began = Date.now(); Date.now() - began < LONG; await pause(100)) {
    if (screen().includes(text)) {
      return;
    }
  }
  throw new Error(`no "${text}" on the screen:\n${screen()}`);
}

/** The parser and the colors of the grammar, where editors look for them. */
function grammar(parser, queries) {
  const own = path.join(repository, 'crates/filpost-lsp/editors/tree-sitter-fil');
  const made = path.join(home, 'grammar');
  if (!fs.existsSync(made)) {
    fs.cpSync(own, made, { recursive: true });
    const run = (...args) => execFileSync(path.join(tools, 'bin/tree-sitter'), args, { cwd: made, stdio: 'pipe' });
    run('generate');
    run('build', '-o', 'fil.so');
  }
  for (const [from, to] of [['fil.so', parser], ['queries/highlights.scm', queries]]) {
    fs.mkdirSync(path.join(home, path.dirname(to)), { recursive: true });
    fs.copyFileSync(path.join(made, from), path.join(home, to));
  }
}

/** Starts an editor with its configuration in a home of its own. */
function start(program, ...args) {
  const folders = ['XDG_CONFIG_HOME=config', 'XDG_DATA_HOME=share', 'XDG_STATE_HOME=state', 'XDG_CACHE_HOME=cache'];
  const env = folders.map((folder) => folder.replace('=', `=${home}/`));
  const search = `PATH=${path.dirname(command)}:${process.env.PATH}`;
  const own = ['env', `HOME=${home}`, ...env, search, 'TERM=tmux-256color', 'COLORTERM=truecolor', 'LANG=C.UTF-8'];
  const size = ['-x', String(SIZE.columns), '-y', String(SIZE.rows)];
  tmux('-f', path.join(home, 'tmux.conf'), 'new-session', '-d', '-s', 'editor', ...size, '-c', workspace, ...own, path.join(tools, 'bin', program), ...args);
}

const line = 1 + fs.readFileSync(path.join(workspace, 'mill.fil'), 'utf8').split('\n').findIndex((text) => text.includes('FIRST = 1'));

const stop = 1 + fs.readFileSync(path.join(workspace, 'mill.fil'), 'utf8').split('\n').findIndex((text) => text.includes('IF (FIRST.EQ.0)'));

const uses = {
  async neovim() {
    write('config/nvim/init.lua', recipe('neovim.md', 'lua'));
    grammar('share/nvim/site/parser/fil.so', 'share/nvim/site/queries/fil/highlights.scm');
    start('nvim', '+set laststatus=0 notermguicolors', 'mill.fil');
    await shows('FIRST = 1');
    keys(`${line}G`, 'o');
    type('SPINDEL/ON');
    keys('Escape');
    await shows('SPINDEL is in no vocabulary');
    // Completion by the editor's own key.
    keys('o');
    type('CYCLE/D');
    keys('C-x', 'C-o');
    await shows('minor word of CYCLE');
    keys('C-e', 'Escape', 'd', 'd');
    keys('/7', 'Enter', 'K');
    await shows('of the current record');
    await picture('neovim');
    keys('Escape', ':qa!', 'Enter');
  },
  async helix() {
    write('config/helix/languages.toml', recipe('helix.md', 'text languages.toml'));
    // Debian's Helix has no themes of true color by default in a terminal without them.
    write('config/helix/config.toml', 'theme = "onelight"\n[editor]\ntrue-color = true\nend-of-line-diagnostics = "hint"\n[editor.lsp]\ndisplay-inlay-hints = true\n');
    grammar('config/helix/runtime/grammars/fil.so', 'config/helix/runtime/queries/fil/highlights.scm');
    start('hx', `mill.fil:${line}`);
    await shows('FIRST = 1');
    keys('o');
    type('SPINDEL/ON');
    keys('Escape');
    await shows('SPINDEL is in no vocabulary');
    await picture('helix');
    keys('o');
    type('CYCLE/DRI');
    await shows('DRILL');
    keys('Escape', 'Escape', ':reload', 'Enter');
    await pause(500);
    // The debugger, which Helix has itself. Its menu stays until Escape.
    keys(`${stop}G`, 'Space', 'G', 'b');
    await pause(500);
    keys('Escape');
    type(':debug-start case .');
    keys('Enter');
    await shows('stopped because of breakpoint');
    keys('Space', 'G', 'v');
    await shows('NUM = 1');
    await shows('LOADTL (word 1055)');
    await picture('helix-debugger');
    keys('Escape', 'Escape', ':q!', 'Enter');
  },
  async emacs() {
    const { dape, config } = debuggerOfEmacs();
    write('.emacs.d/init.el', `(setq inhibit-startup-screen t frame-background-mode 'light)\n(menu-bar-mode -1)\n${recipe('emacs.md', 'elisp')}${config}`);
    start('emacs', '-nw', `+${line}`, 'mill.fil');
    await shows('FIRST = 1');
    await shows('eglot');
    keys('C-e', 'Enter');
    type('SPINDEL/ON');
    await pause(2000);
    keys('M-x');
    type('flymake-show-buffer-diagnostics');
    keys('Enter');
    await shows('SPINDEL is in no');
    await picture('emacs');
    if (dape) {
      await debugInEmacs();
    } else {
      console.log('emacs: no dape, its debugger was not tried');
    }
    keys('C-x', 'C-c');
    await pause(500);
    type('n');
  },
};

/** Debian's package of dape with its configuration of the page, where the tools have it. */
function debuggerOfEmacs() {
  const packages = path.join(tools, 'root/usr/share/emacs/site-lisp/elpa-src');
  const names = fs.existsSync(packages) ? fs.readdirSync(packages) : [];
  const dape = names.find((name) => name.startsWith('dape-'));
  const config = dape ? `(add-to-list 'load-path "${path.join(packages, dape)}")\n${recipe('emacs.md', 'elisp dape')}` : '';
  return { dape, config };
}

async function debugInEmacs() {
  const command = async (name) => {
    keys('M-x');
    await shows('M-x');
    type(name);
    keys('Enter');
    await pause(500);
  };
  // The text as it was saved, alone on the screen.
  await command('delete-other-windows');
  keys('C-x', 'b');
  type('mill.fil');
  keys('Enter');
  await command('revert-buffer-quick');
  await pause(500);
  type('yes');
  keys('Enter');
  await command('goto-line');
  type(String(stop));
  keys('Enter');
  await command('dape-breakpoint-toggle');
  await command('dape');
  await shows('Run adapter: filpost');
  keys('Enter');
  await shows('NUM');
  await shows('=>section LOADTL');
  await picture('emacs-debugger');
}

/** The screen of the terminal as a picture: its colors become spans of a page. */
async function picture(name) {
  let chromium;
  try {
    ({ chromium } = require('playwright-core'));
  } catch {
    return;
  }
  const browser = await chromium.launch({ executablePath: process.env.FILPOST_CHROMIUM, args: ['--no-sandbox'] });
  const page = await browser.newPage();
  await page.setContent(`<body style="margin:0"><pre style="font:14px/1.25 'DejaVu Sans Mono',monospace;margin:0;padding:6px;background:#fdfdfd;color:#222;display:inline-block">${spans(tmux('capture-pane', '-p', '-e', '-t', 'editor'))}</pre></body>`);
  await page.locator('pre').screenshot({ path: path.join(pictures, `${name}.png`) });
  await browser.close();
}

const BASIC = ['#222222', '#b02020', '#207020', '#806000', '#2040b0', '#802080', '#107070', '#808080', '#555555', '#d03030', '#309030', '#a08020', '#3060d0', '#a030a0', '#209090', '#ffffff'];

function indexed(number) {
  if (number < 16) {
    return BASIC[number];
  }
  if (number > 231) {
    const grey = 8 + (number - 232) * 10;
    return `rgb(${grey},${grey},${grey})`;
  }
  const level = (part) => (part === 0 ? 0 : 55 + part * 40);
  const cube = number - 16;
  return `rgb(${level(Math.floor(cube / 36))},${level(Math.floor(cube / 6) % 6)},${level(cube % 6)})`;
}

/** Escape sequences of colors as HTML. */
function spans(text) {
  let style = {};
  const escaped = (part) => part.replace(/[&<>]/g, (sign) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;' })[sign]);
  const span = (part) => {
    const [front, back] = style.reverse ? [style.back ?? '#fdfdfd', style.front ?? '#222'] : [style.front, style.back];
    const rules = [front && `color:${front}`, back && `background:${back}`, style.bold && 'font-weight:bold', style.under && 'text-decoration:underline'];
    return part ? `<span style="${rules.filter(Boolean).join(';')}">${escaped(part)}</span>` : '';
  };
  return text.split('\u001b[').map((part, index) => {
    const found = index > 0 && /^([\d;:]*)m/.exec(part);
    if (!found) {
      return span(part);
    }
    style = restyled(style, found[1].split(';').map((code) => code.split(':').map(Number)));
    return span(part.slice(found[0].length));
  }).join('');
}

function restyled(old, codes) {
  const style = { ...old };
  for (let at = 0; at < codes.length; at += 1) {
    const [code, ...more] = codes[at];
    if (code === 38 || code === 48) {
      const rest = more.length > 0 ? more : codes.slice(at + 1).map(([number]) => number);
      const color = rest[0] === 5 ? indexed(rest[1]) : `rgb(${rest.slice(-3).join(',')})`;
      const plain = rest[0] === 5 ? 2 : 4;
      style[code === 38 ? 'front' : 'back'] = rest[0] === 2 && more.length === 0 ? `rgb(${rest.slice(1, 4).join(',')})` : color;
      at += more.length > 0 ? 0 : plain;
    } else if (code === 0) {
      Object.keys(style).forEach((key) => delete style[key]);
    } else if (code === 1) {
      style.bold = true;
    } else if (code === 4) {
      style.under = more[0] !== 0;
    } else if (code === 7) {
      style.reverse = true;
    } else if (code === 22) {
      style.bold = false;
    } else if (code === 24) {
      style.under = false;
    } else if (code === 27) {
      style.reverse = false;
    } else if (code === 39) {
      delete style.front;
    } else if (code === 49) {
      delete style.back;
    } else if (code >= 30 && code < 38) {
      style.front = BASIC[code - 30];
    } else if (code >= 40 && code < 48) {
      style.back = BASIC[code - 40];
    } else if (code >= 90 && code < 98) {
      style.front = BASIC[code - 82];
    } else if (code >= 100 && code < 108) {
      style.back = BASIC[code - 92];
    }
  }
  return style;
}

async function main() {
  write('tmux.conf', 'set -g default-terminal tmux-256color\nset -ga terminal-overrides ",*:RGB"\nset -g status off\nset -sg escape-time 0\n');
  for (const name of editors) {
    await uses[name]();
    console.log(`${name} passed`);
    try {
      tmux('kill-session', '-t', 'editor');
    } catch {
      // It has ended by itself.
    }
  }
}

main().catch((error) => {
  console.error(error.message);
  process.exitCode = 1;
}).finally(() => {
  try {
    tmux('kill-server');
  } catch {
    // No session is left.
  }
  fs.rmSync(home, { recursive: true, force: true });
});
