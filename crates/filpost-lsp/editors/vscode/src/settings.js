// A form for machine.toml: its fields come from the schema that `filpost machine schema` prints,
// its values from the text, and each change is an edit of the text.
const fs = require('fs');
const path = require('path');
const vscode = require('vscode');
const { exec } = require('./command');

function register(context, request) {
  const open = async (uri) => {
    const own = uri ?? vscode.window.activeTextEditor?.document.uri;
    if (!own || !own.fsPath.endsWith('.toml')) {
      vscode.window.showErrorMessage('filpost: the form is for a machine.toml.');
      return;
    }
    await form(context, request, own);
  };
  context.subscriptions.push(vscode.commands.registerCommand('filpost.settings', open));
}

async function form(context, request, uri) {
  const document = await vscode.workspace.openTextDocument(uri);
  const { code, stdout, output } = await exec(['machine', 'schema']);
  if (code !== 0) {
    vscode.window.showErrorMessage(`filpost machine schema: ${output}`);
    return;
  }
  const title = `Settings of ${path.basename(path.dirname(uri.fsPath))}/${path.basename(uri.fsPath)}`;
  const options = { enableScripts: true, retainContextWhenHidden: true };
  const panel = vscode.window.createWebviewPanel('filpostSettings', title, vscode.ViewColumn.Beside, options);
  const textDocument = { uri: uri.toString() };
  const page = fs.readFileSync(path.join(context.extensionPath, 'src', 'settings.html'), 'utf8');
  const send = async () => {
    const { values, rows } = await request('filpost/settings', { textDocument });
    panel.webview.postMessage({ values, rows, schema: JSON.parse(stdout) });
  };
  const change = async ({ key, value }) => {
    try {
      const edits = await request('filpost/setting', { textDocument, key, value });
      const edit = new vscode.WorkspaceEdit();
      for (const { range, newText } of edits) {
        const { start, end } = range;
        const place = new vscode.Range(start.line, start.character, end.line, end.character);
        edit.replace(uri, place, newText);
      }
      await vscode.workspace.applyEdit(edit);
    } catch (error) {
      panel.webview.postMessage({ key, wrong: error.message });
    }
  };
  const edited = vscode.workspace.onDidChangeTextDocument((event) => {
    if (event.document === document) {
      send();
    }
  });
  panel.onDidDispose(() => edited.dispose());
  panel.webview.onDidReceiveMessage((message) => (message.ready ? send() : change(message)));
  panel.webview.html = page;
}

module.exports = { register };
