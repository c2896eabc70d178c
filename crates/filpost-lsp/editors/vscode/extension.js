// The extension: the language server, the debugger, the cases, the NC preview, the plot and the
// form of settings. All knowledge of FIL is in the command; this connects it with the editor.
const vscode = require('vscode');
const { LanguageClient } = require('vscode-languageclient/node');
const cases = require('./src/cases');
const { command } = require('./src/command');
const debug = require('./src/debug');
const fresh = require('./src/new');
const { Preview } = require('./src/preview');
const settings = require('./src/settings');

let client;

async function startServer() {
  const selector = [
    { scheme: 'file', language: 'fil' },
    { scheme: 'file', language: 'cl' },
    { scheme: 'file', pattern: '**/machine.toml' },
  ];
  const server = { command: command(), args: ['lsp'] };
  const watcher = vscode.workspace.createFileSystemWatcher('**/{case,machine}.toml');
  client = new LanguageClient('filpost', 'filpost', server, {
    documentSelector: selector,
    synchronize: { fileEvents: watcher },
  });
  try {
    await client.start();
  } catch (error) {
    vscode.window.showErrorMessage(`filpost does not start: ${error.message}. Set "filpost.command".`);
  }
}

/** Asks the language server. */
function request(method, params) {
  return client.sendRequest(method, params);
}

/** The folder of the case that a document belongs to. */
function caseOf(document) {
  return request('filpost/caseOf', { textDocument: { uri: document.uri.toString() } });
}

async function activate(context) {
  debug.register(context, caseOf);
  settings.register(context, request);
  fresh.register(context, request, caseOf);
  new Preview(context, request, caseOf);
  context.subscriptions.push(
    vscode.commands.registerCommand('filpost.restart', async () => {
      await client?.stop();
      await startServer();
    }),
  );
  await startServer();
  await cases.register(context);
}

function deactivate() {
  return client?.stop();
}

module.exports = { activate, deactivate };
