// Drives `filpost dap` with the client that adapters of VS Code are tested with.
// Arguments: the command, the folder of a case, the script of the case, a line of it.
const { DebugClient } = require('@vscode/debugadapter-testsupport');
const assert = require('assert');

const [command, folder, script, line, cl] = process.argv.slice(2);

async function session(test) {
  const client = new DebugClient(command, 'dap', 'filpost');
  client.defaultTimeout = 30000;
  await client.start();
  try {
    await test(client);
  } finally {
    await client.stop();
  }
}

async function value(client, expression) {
  return (await client.evaluateRequest({ expression })).body.result;
}

async function main() {
  // A line of FIL, with the stack below it, and a step over and out.
  await session(async (client) => {
    await client.hitBreakpoint({ case: folder }, { path: script, line: Number(line) });
    const frames = (await client.stackTraceRequest({ threadId: 1 })).body.stackFrames;
    assert.match(frames[0].name, /^(section|macro) /);
    assert.match(frames[frames.length - 1].name, /^record \d+: /);
    const scopes = (await client.scopesRequest({ frameId: 1 })).body.scopes;
    assert(scopes.some((scope) => scope.name === 'Record'));
    assert.match(await value(client, 'POSTF(5)'), /^\d+$/);
    await Promise.all([client.nextRequest({ threadId: 1 }), client.waitForEvent('stopped')]);
    await Promise.all([client.stepOutRequest({ threadId: 1 }), client.waitForEvent('stopped')]);
    await Promise.all([client.stepBackRequest({ threadId: 1 }), client.waitForEvent('stopped')]);
    await Promise.all([client.continueRequest({ threadId: 1 }), client.waitForEvent('terminated')]);
  });
  // A line of the CL file.
  await session(async (client) => {
    await client.hitBreakpoint({ case: folder }, { path: cl, line: 3 });
  });
  // A condition that never holds lets the run end, and a log point speaks.
  await session(async (client) => {
    const breakpoints = [
      { line: Number(line), condition: '1.EQ.2' },
      { line: Number(line), logMessage: 'words: {POSTF(5)}' },
    ];
    await Promise.all([
      client.waitForEvent('initialized').then(async () => {
        await client.setBreakpointsRequest({ source: { path: script }, breakpoints });
        await client.configurationDoneRequest();
      }),
      client.launch({ case: folder }),
      client.assertOutput('console', 'words: '),
      client.waitForEvent('terminated'),
    ]);
  });
  // A record, a block and a name that is watched.
  await session(async (client) => {
    await Promise.all([
      client.waitForEvent('initialized').then(async () => {
        const named = { breakpoints: [{ name: 'record FINI' }] };
        const placed = await client.setFunctionBreakpointsRequest(named);
        assert(placed.body.breakpoints[0].verified);
        await client.configurationDoneRequest();
      }),
      client.launch({ case: folder }),
      client.assertStoppedLocation('breakpoint', { path: cl }),
    ]);
  });
  console.log('all sessions passed');
}

main().catch((error) => {
  console.error(error);
  process.exit(1);
});
