// The NC program of a case while its files are edited: beside them as a text whose lines lead to the
// CL record and the FIL lines that made them and back, and as a plot.
const path = require('path');
const vscode = require('vscode');

const SCHEME = 'filpost-nc';
/** From the last keystroke to the post, milliseconds. */
const PAUSE = 200;

/** Behind the page of a plot: the line of the program that is chosen there is told to the editor. */
const TELLS = `<script>
  const editor = acquireVsCodeApi();
  document.addEventListener('line-chosen', (event) => editor.postMessage({ line: event.detail }));
</script>`;

/** The programs of cases, by their folders. */
class Preview {
  constructor(context, request, caseOf) {
    this.request = request;
    this.caseOf = caseOf;
    /** What the server answered, with the text that is shown. */
    this.shown = new Map();
    /** How often a case was posted: an answer that comes late is dropped. */
    this.turns = new Map();
    /** Panels with plots. */
    this.plots = new Map();
    this.changed = new vscode.EventEmitter();
    this.mark = vscode.window.createTextEditorDecorationType({
      isWholeLine: true,
      backgroundColor: new vscode.ThemeColor('editor.rangeHighlightBackground'),
      overviewRulerColor: new vscode.ThemeColor('editorOverviewRuler.rangeHighlightForeground'),
    });
    const provider = {
      onDidChange: this.changed.event,
      provideTextDocumentContent: (uri) => this.shown.get(folderOf(uri))?.text ?? '',
    };
    context.subscriptions.push(
      this.mark,
      this.changed,
      vscode.workspace.registerTextDocumentContentProvider(SCHEME, provider),
      vscode.languages.registerDefinitionProvider({ scheme: SCHEME }, {
        provideDefinition: (document, at) => this.causes(document.uri, at.line).map((cause) => cause.location),
      }),
      vscode.languages.registerHoverProvider({ scheme: SCHEME }, {
        provideHover: (document, at) => this.hover(document.uri, at.line),
      }),
      vscode.commands.registerCommand('filpost.preview', () => this.open(false)),
      vscode.commands.registerCommand('filpost.plot', () => this.open(true)),
      vscode.commands.registerCommand('filpost.toCl', () => this.jump('cl')),
      vscode.commands.registerCommand('filpost.toFil', () => this.jump('fil')),
      vscode.workspace.onDidChangeTextDocument((event) => this.edited(event.document)),
      vscode.workspace.onDidCloseTextDocument((document) => {
        if (document.uri.scheme === SCHEME && !this.plots.has(folderOf(document.uri))) {
          this.shown.delete(folderOf(document.uri));
        }
      }),
      vscode.window.onDidChangeTextEditorSelection((event) => this.selected(event)),
    );
  }

  /** Opens the program, or the plot, of the case of the file that is edited. */
  async open(plot) {
    const editor = vscode.window.activeTextEditor;
    const document = editor?.document;
    const isProgram = document?.uri.scheme === SCHEME;
    const folder = isProgram ? folderOf(document.uri) : document && (await this.caseOf(document));
    if (!folder) {
      vscode.window.showErrorMessage('filpost: this file belongs to no case; a case is a folder with a case.toml.');
      return;
    }
    if (plot && !this.plots.has(folder)) {
      const title = `Plot of ${path.basename(folder)}`;
      const view = { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true };
      const panel = vscode.window.createWebviewPanel('filpostPlot', title, view, { enableScripts: true });
      panel.onDidDispose(() => this.plots.delete(folder));
      panel.webview.onDidReceiveMessage(({ line }) => this.fromPlot(folder, line));
      this.plots.set(folder, panel);
    }
    await this.post(folder);
    if (!plot) {
      const program = await vscode.workspace.openTextDocument(uriOf(folder));
      await vscode.languages.setTextDocumentLanguage(program, 'filpost-nc');
      const view = { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true, preview: false };
      await vscode.window.showTextDocument(program, view);
    }
  }

  /** A file was edited: the cases that are shown may have changed. */
  edited(document) {
    const known = ['fil', 'cl', 'toml'].includes(document.languageId) || document.fileName.endsWith('.toml');
    if (document.uri.scheme !== 'file' || !known || this.shown.size === 0) {
      return;
    }
    clearTimeout(this.timer);
    this.timer = setTimeout(async () => {
      for (const folder of [...this.shown.keys()]) {
        await this.post(folder);
      }
    }, PAUSE);
  }

  /** Has the server post a case as it stands in the editor. */
  async post(folder) {
    const turn = (this.turns.get(folder) ?? 0) + 1;
    this.turns.set(folder, turn);
    let made;
    try {
      made = await this.request('filpost/preview', { case: folder, plot: this.plots.has(folder) });
    } catch (error) {
      made = { refused: [String(error.message ?? error)] };
    }
    if (this.turns.get(folder) !== turn) {
      return;
    }
    // A refused case has no program: what was made before must not be taken for it.
    made.text = made.refused ? `refused, no program\n\n${made.refused.join('\n\n')}\n` : made.nc;
    this.shown.set(folder, made);
    this.changed.fire(uriOf(folder));
    const panel = this.plots.get(folder);
    if (panel) {
      const refused = made.refused?.join('\n\n') ?? made.page?.refused;
      panel.webview.html = refused ? `<pre>${escaped(refused)}</pre>` : made.page + TELLS;
    }
    this.tell(made);
  }

  tell(made) {
    const count = made.warnings?.length ?? 0;
    const lines = `${made.lines?.length ?? 0} lines, ${count} ${count === 1 ? 'warning' : 'warnings'}`;
    const text = made.refused ? 'filpost: refused' : `filpost: ${lines}, ${made.milliseconds} ms`;
    vscode.window.setStatusBarMessage(text, 10000);
  }

  /** What made a line of a program: its CL record, then its lines of FIL, innermost first. */
  causes(uri, line) {
    const made = this.shown.get(folderOf(uri));
    const [cl, fil] = made?.lines?.[line] ?? [0, []];
    const location = (file, number) =>
      new vscode.Location(vscode.Uri.parse(file), new vscode.Position(number - 1, 0));
    const causes = fil.map(([file, number]) => ({ kind: 'fil', location: location(made.fil[file], number) }));
    if (cl > 0) {
      causes.push({ kind: 'cl', location: location(made.cl, cl) });
    }
    return causes;
  }

  hover(uri, line) {
    const causes = this.causes(uri, line);
    const lines = causes.map(({ kind, location }) => {
      const name = path.basename(location.uri.fsPath);
      const number = location.range.start.line + 1;
      const target = location.uri.with({ fragment: `L${number}` });
      return `${kind === 'cl' ? 'CL record' : 'FIL'}: [${name}:${number}](${target})`;
    });
    const text = lines.length > 0 ? lines.join('\n\n') : 'counted by the post or asked for by the settings';
    return new vscode.Hover(new vscode.MarkdownString(text));
  }

  /** Goes from the line of the program under the cursor to what made it. */
  async jump(kind) {
    const editor = vscode.window.activeTextEditor;
    const causes = editor ? this.causes(editor.document.uri, editor.selection.active.line) : [];
    const cause = causes.find((cause) => cause.kind === kind);
    if (!cause) {
      const what = kind === 'cl' ? 'CL record' : 'line of FIL';
      vscode.window.setStatusBarMessage(`filpost: no ${what} made this line`, 5000);
      return;
    }
    await this.reveal(cause.location, false);
  }

  /** A click in the program shows what made the line; one in a CL or FIL file what it made. */
  async selected(event) {
    if (event.kind !== vscode.TextEditorSelectionChangeKind.Mouse || this.shown.size === 0) {
      return;
    }
    const { document } = event.textEditor;
    const line = event.selections[0].active.line;
    if (document.uri.scheme === SCHEME) {
      await this.fromProgram(event.textEditor, line);
    } else if (document.uri.scheme === 'file') {
      await this.fromSource(event.textEditor, line);
    }
  }

  /** A line of the program was chosen in its plot, 1-based. */
  async fromPlot(folder, line) {
    this.clear();
    const program = visible(uriOf(folder))[0];
    program?.setDecorations(this.mark, [lineRange(line - 1)]);
    program?.revealRange(lineRange(line - 1), vscode.TextEditorRevealType.InCenterIfOutsideViewport);
    await this.show(this.causes(uriOf(folder), line - 1));
  }

  async fromProgram(editor, line) {
    this.clear();
    editor.setDecorations(this.mark, [lineRange(line)]);
    await this.show(this.causes(editor.document.uri, line));
  }

  /** Shows what made a line of a program. */
  async show(causes) {
    const shown = (location) => visible(location.uri).length > 0;
    const wanted = causes.filter((cause) => shown(cause.location));
    // With neither file in view, the innermost cause is opened.
    const reveal = wanted.length > 0 ? wanted : causes.slice(0, 1);
    const done = new Set();
    for (const { location } of reveal) {
      if (!done.has(location.uri.toString())) {
        done.add(location.uri.toString());
        await this.reveal(location, true);
      }
    }
  }

  async fromSource(editor, line) {
    const uri = editor.document.uri.toString();
    for (const [folder, made] of this.shown) {
      const program = visible(uriOf(folder))[0];
      if (!program || !made.lines) {
        continue;
      }
      const file = made.fil.findIndex((name) => same(name, uri));
      const isCl = same(made.cl, uri);
      const lines = [];
      made.lines.forEach(([cl, fil], number) => {
        const byFil = fil.some(([own, at]) => own === file && at === line + 1);
        if ((isCl && cl === line + 1) || byFil) {
          lines.push(number);
        }
      });
      if (file < 0 && !isCl) {
        continue;
      }
      this.clear();
      editor.setDecorations(this.mark, [lineRange(line)]);
      program.setDecorations(this.mark, lines.map(lineRange));
      if (lines.length > 0) {
        program.revealRange(lineRange(lines[0]), vscode.TextEditorRevealType.InCenterIfOutsideViewport);
      }
    }
  }

  /** Shows a line, in the editor that has the file or in the first column. */
  async reveal(location, keepsFocus) {
    let editors = visible(location.uri);
    if (editors.length === 0 || !keepsFocus) {
      const column = editors[0]?.viewColumn ?? vscode.ViewColumn.One;
      const view = { viewColumn: column, preserveFocus: keepsFocus, selection: location.range };
      editors = [await vscode.window.showTextDocument(location.uri, view)];
    }
    for (const editor of editors) {
      editor.setDecorations(this.mark, [lineRange(location.range.start.line)]);
      editor.revealRange(location.range, vscode.TextEditorRevealType.InCenterIfOutsideViewport);
    }
  }

  clear() {
    vscode.window.visibleTextEditors.forEach((editor) => editor.setDecorations(this.mark, []));
  }
}

function uriOf(folder) {
  return vscode.Uri.file(path.join(folder, `${path.basename(folder)} (posted).nc`)).with({ scheme: SCHEME });
}

function folderOf(uri) {
  return path.dirname(uri.with({ scheme: 'file' }).fsPath);
}

function same(one, other) {
  return vscode.Uri.parse(one).fsPath === vscode.Uri.parse(other).fsPath;
}

function visible(uri) {
  const editors = vscode.window.visibleTextEditors;
  return editors.filter((editor) => same(editor.document.uri.toString(), uri.toString())
    && editor.document.uri.scheme === uri.scheme);
}

function lineRange(line) {
  return new vscode.Range(line, 0, line, 0);
}

function escaped(text) {
  return text.replace(/[&<>]/g, (sign) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;' })[sign]);
}

module.exports = { Preview };
