// The cases of the workspace as tests: found by their case.toml, run by `filpost test`.
const path = require('path');
const vscode = require('vscode');
const { exec } = require('./command');

function register(context) {
  const controller = vscode.tests.createTestController('filpost', 'filpost cases');
  const watcher = vscode.workspace.createFileSystemWatcher('**/case.toml', false, true, false);
  const item = (file) => {
    const folder = path.dirname(file.fsPath);
    const isRoot = vscode.workspace.workspaceFolders?.some((open) => open.uri.fsPath === folder);
    const label = isRoot ? path.basename(folder) : vscode.workspace.asRelativePath(folder);
    return controller.createTestItem(folder, label, file);
  };
  const find = async () => {
    const files = await vscode.workspace.findFiles('**/case.toml', '**/node_modules/**');
    controller.items.replace(files.map(item));
  };
  controller.resolveHandler = find;
  controller.refreshHandler = find;
  const run = async (request, token) => {
    const testRun = controller.createTestRun(request);
    for (const test of request.include ?? [...controller.items].map(([, test]) => test)) {
      if (token.isCancellationRequested) {
        break;
      }
      await runOne(testRun, test);
    }
    testRun.end();
  };
  const debug = async (request) => {
    for (const test of request.include ?? []) {
      const configuration = { type: 'filpost', request: 'launch', name: test.label, case: test.id };
      await vscode.debug.startDebugging(undefined, configuration);
    }
  };
  controller.createRunProfile('Run', vscode.TestRunProfileKind.Run, run, true);
  controller.createRunProfile('Debug', vscode.TestRunProfileKind.Debug, debug, true);
  context.subscriptions.push(
    controller,
    watcher,
    watcher.onDidCreate((file) => controller.items.add(item(file))),
    watcher.onDidDelete((file) => controller.items.delete(path.dirname(file.fsPath))),
  );
  return find();
}

async function runOne(testRun, test) {
  testRun.started(test);
  const began = Date.now();
  const { code, output } = await exec(['test', test.id]);
  testRun.appendOutput(output.replace(/\r?\n/g, '\r\n'), undefined, test);
  const time = Date.now() - began;
  if (code === 0) {
    testRun.passed(test, time);
    return;
  }
  const message = new vscode.TestMessage(output);
  message.location = new vscode.Location(test.uri, new vscode.Position(0, 0));
  testRun.failed(test, message, time);
}

module.exports = { register };
