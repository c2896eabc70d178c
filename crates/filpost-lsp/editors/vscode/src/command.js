// The command `filpost`, run.
const { execFile } = require('child_process');
const vscode = require('vscode');

/** The command as the settings name it. */
function command() {
  return vscode.workspace.getConfiguration('filpost').get('command') || 'filpost';
}

/** Runs the command; gives its status and what it says on both streams. */
function exec(args) {
  return new Promise((resolve) => {
    execFile(command(), args, { maxBuffer: 64 << 20 }, (error, stdout, stderr) => {
      const code = error ? error.code ?? 1 : 0;
      resolve({ code, stdout, output: stdout + stderr || String(error ?? '') });
    });
  });
}

module.exports = { command, exec };
