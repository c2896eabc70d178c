// The extension: the language server, the debugger and the regression cases of `filpost`.
// All knowledge of FIL is in the command; this file only connects it with the editor.
const { execFile } = require('child_process');
const fs = require('fs');
const path = require('path');
const vscode = require('vscode');
const { LanguageClient } = require('vscode-languageclient/node');

let client;

function command() {
  return vscode.workspace.getConfiguration('filpost').get('command') || 'filpost';
}

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

/** A configuration for F5 without a launch.json: the case of the folder of the open file. */
const configurations = {
  resolveDebugConfiguration(folder, configuration) {
    if (configuration.type && (configuration.case || configuration.cl)) {
      return configuration;
    }
    const document = vscode.window.activeTextEditor?.document;
    const cases = document ? caseOf(path.dirname(document.uri.fsPath)) : undefined;
    if (!cases) {
      vscode.window.showErrorMessage('filpost: name a case (a folder with a case.toml) in launch.json.');
      return undefined;
    }
    return { type: 'filpost', request: 'launch', name: 'Debug the case', case: cases, cwd: folder?.uri.fsPath };
  },
};

/** The nearest folder with a case.toml, beside or above. */
function caseOf(folder) {
  for (let at = folder; ; at = path.dirname(at)) {
    if (fs.existsSync(path.join(at, 'case.toml'))) {
      return at;
    }
    if (path.dirname(at) === at) {
      return undefined;
    }
  }
}

/** The cases of the workspace as tests: found by their case.toml, run by `filpost test`. */
function tests(context) {
  const controller = vscode.tests.createTestController('filpost', 'filpost cases');
  context.subscriptions.push(controller);
  const find = async () => {
    const files = await vscode.workspace.findFiles('**/case.toml', '**/node_modules/**');
    controller.items.replace(
      files.map((file) => {
        const folder = path.dirname(file.fsPath);
        return controller.createTestItem(folder, vscode.workspace.asRelativePath(folder), file);
      }),
    );
  };
  controller.resolveHandler = find;
  controller.refreshHandler = find;
  const run = async (request, token) => {
    const run = controller.createTestRun(request);
    const items = request.include ?? [...controller.items].map(([, item]) => item);
    for (const item of items) {
      if (token.isCancellationRequested) {
        break;
      }
      run.started(item);
      const began = Date.now();
      const { code, output } = await exec(['test', item.id]);
      run.appendOutput(output.replace(/\r?\n/g, '\r\n'), undefined, item);
      const time = Date.now() - began;
      if (code === 0) {
        run.passed(item, time);
      } else {
        run.failed(item, new vscode.TestMessage(output), time);
      }
    }
    run.end();
  };
  controller.createRunProfile('Run', vscode.TestRunProfileKind.Run, run, true);
  const debug = async (request) => {
    for (const item of request.include ?? []) {
      const configuration = { type: 'filpost', request: 'launch', name: item.label, case: item.id };
      await vscode.debug.startDebugging(undefined, configuration);
    }
  };
  controller.createRunProfile('Debug', vscode.TestRunProfileKind.Debug, debug, true);
}

/** Runs the command; gives its status and all that it says. */
function exec(args) {
  return new Promise((resolve) => {
    execFile(command(), args, { maxBuffer: 64 << 20 }, (error, stdout, stderr) => {
      const code = error ? error.code ?? 1 : 0;
      resolve({ code, output: stdout + stderr || String(error ?? '') });
    });
  });
}

async function activate(context) {
  const adapter = {
    createDebugAdapterDescriptor: () => new vscode.DebugAdapterExecutable(command(), ['dap']),
  };
  const step = (name) => () => {
    const session = vscode.debug.activeDebugSession;
    return session?.type === 'filpost' ? session.customRequest(name) : undefined;
  };
  context.subscriptions.push(
    vscode.debug.registerDebugAdapterDescriptorFactory('filpost', adapter),
    vscode.debug.registerDebugConfigurationProvider('filpost', configurations),
    vscode.commands.registerCommand('filpost.nextRecord', step('nextRecord')),
    vscode.commands.registerCommand('filpost.nextBlock', step('nextBlock')),
    vscode.commands.registerCommand('filpost.restart', async () => {
      await client?.stop();
      await startServer();
    }),
  );
  tests(context);
  await startServer();
}

function deactivate() {
  return client?.stop();
}

module.exports = { activate, deactivate };
