// A new post, and the program of a case taken as the expected one.
const path = require('path');
const vscode = require('vscode');
const { exec } = require('./command');

function register(context, request, caseOf) {
  context.subscriptions.push(
    vscode.commands.registerCommand('filpost.new', () => make(request)),
    vscode.commands.registerCommand('filpost.accept', () => accept(caseOf)),
  );
}

/** Makes the folder of a post in the folder that is open. */
async function make(request) {
  const folder = vscode.workspace.workspaceFolders?.[0]?.uri.fsPath;
  if (!folder) {
    vscode.window.showErrorMessage('filpost: open a folder first.');
    return;
  }
  const name = await vscode.window.showInputBox({ prompt: 'Name of the post: its folder, made in the open one' });
  const posts = name && (await request('filpost/posts', {}));
  const base = posts && (await vscode.window.showQuickPick(posts, { placeHolder: 'The ready post to begin from' }));
  if (!base) {
    return;
  }
  const { code, output } = await exec(['new', path.join(folder, name), '--base', base]);
  if (code !== 0) {
    vscode.window.showErrorMessage(`filpost new: ${output}`);
    return;
  }
  const script = vscode.Uri.file(path.join(folder, name, 'post.fil'));
  await vscode.window.showTextDocument(script, { preview: false });
}

/** Takes the program that the case of the active file makes now as the expected one. */
async function accept(caseOf) {
  const document = vscode.window.activeTextEditor?.document;
  const folder = document && (await caseOf(document));
  if (!folder) {
    vscode.window.showErrorMessage('filpost: this file belongs to no case.');
    return;
  }
  const { output } = await exec(['test', folder, '--update']);
  vscode.window.showInformationMessage(`filpost: ${output.trim().split('\n').pop()}`);
}

module.exports = { register };
