// The debugger: its adapter, a configuration for F5, the steps of our own.
const vscode = require('vscode');
const { command } = require('./command');

/** Registers the debugger; `caseOf` gives the case folder of a document. */
function register(context, caseOf) {
  const adapter = {
    createDebugAdapterDescriptor: () => new vscode.DebugAdapterExecutable(command(), ['dap']),
  };
  // F5 without a launch.json debugs the case of the open file.
  const configurations = {
    async resolveDebugConfiguration(folder, configuration) {
      if (configuration.type && (configuration.case || configuration.cl)) {
        return configuration;
      }
      const document = vscode.window.activeTextEditor?.document;
      const found = document && (await caseOf(document));
      if (!found) {
        vscode.window.showErrorMessage('filpost: name a case (a folder with a case.toml) in launch.json.');
        return undefined;
      }
      return { type: 'filpost', request: 'launch', name: 'Debug the case', case: found, cwd: folder?.uri.fsPath };
    },
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
  );
}

module.exports = { register };
