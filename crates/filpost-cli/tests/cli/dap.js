// Drives `filpost dap` with the client that adapters of VS Code are tested with.
// Arguments: the command, the folder of a case, the script of the case, a line of it, its CL file, its program.
const { DebugClient } = require('@vscode/debugadapter-testsupport');
const assert = require('assert');

const [command, folder, script, line, cl, nc] = process.argv.slice(2);

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

/** Waits for the stop that a request leads to. */
async function stopped(client, ask) {
  const [stop] = await Promise.all([client.waitForEvent('stopped'), ask()]);
  return stop;
}

/** Launches the case with breakpoints, up to its first stop. */
async function started(client, place) {
  const [stop] = await Promise.all([
    client.waitForEvent('stopped'),
    client.waitForEvent('initialized').then(async () => {
      await place();
      await client.configurationDoneRequest();
    }),
    client.launch({ case: folder }),
  ]);
  return stop;
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
  // A block of the last program by its line, and one by a text in it.
  await session(async (client) => {
    const fs = require('fs');
    const lines = fs.readFileSync(nc, 'utf8').split('\n');
    const block = lines.findIndex((text) => text.includes('G92')) + 1;
    const first = await started(client, async () => {
      const placed = await client.setBreakpointsRequest({ source: { path: nc }, breakpoints: [{ line: block }] });
      assert(placed.body.breakpoints[0].verified);
    });
    assert(first.body.text.includes(lines[block - 1]), first.body.text);
    await client.setFunctionBreakpointsRequest({ breakpoints: [{ name: 'block X52.' }] });
    const second = await stopped(client, () => client.continueRequest({ threadId: 1 }));
    assert.match(second.body.text, /X52\./);
    // On by a block and by a record, back by a block.
    const on = await stopped(client, () => client.customRequest('nextBlock', { threadId: 1 }));
    assert.equal(on.body.reason, 'step');
    const back = await stopped(client, () => client.reverseContinueRequest({ threadId: 1 }));
    assert(['step', 'goto'].includes(back.body.reason), back.body.reason);
    await client.setFunctionBreakpointsRequest({ breakpoints: [] });
    await client.setBreakpointsRequest({ source: { path: nc }, breakpoints: [] });
    await stopped(client, () => client.customRequest('nextRecord', { threadId: 1 }));
    const frames = (await client.stackTraceRequest({ threadId: 1 })).body.stackFrames;
    assert.equal(frames.length, 1);
    assert.match(frames[0].name, /^record \d+: /);
  });
  // The third time a macro is called, by a count of hits; then values are set and read.
  await session(async (client) => {
    await started(client, async () => {
      const named = { breakpoints: [{ name: 'macro ROUGH', hitCondition: '== 3' }] };
      assert((await client.setFunctionBreakpointsRequest(named)).body.breakpoints[0].verified);
    });
    assert.equal(await value(client, 'ILAY'), '3');
    await client.evaluateRequest({ expression: 'ILAY=1', context: 'repl' });
    assert.equal(await value(client, 'ILAY'), '1');
    const set = await client.customRequest('setExpression', { expression: 'ILAY', value: '2' });
    assert.equal(set.body.value, '2');
    assert.equal(await value(client, 'ILAY+1'), '3');
    await assert.rejects(value(client, 'POSTF(13)'));
  });
  // Data breakpoints on a name, a common by its setting and by its number, and an address. The
  // script takes messages off the tape for its table (INTCOM 484) and gives them back.
  const onOff = [/^INTCOM 484 was 1 and is 0$/, /^INTCOM 484 was 0 and is 1$/];
  for (const [name, texts] of [
    ['ILAY', [/^ILAY /]],
    ['message.to_tape', onOff],
    ['INTCOM 484', onOff],
    ['seqno.increment', []],
    ['address Z', [/^Z /]],
  ]) {
    await session(async (client) => {
      await Promise.all([
        client.waitForEvent('initialized').then(() => client.configurationDoneRequest()),
        client.launch({ case: folder, stopOnEntry: true }),
        client.waitForEvent('stopped'),
      ]);
      const { dataId } = (await client.customRequest('dataBreakpointInfo', { name })).body;
      assert(dataId, name);
      const placed = await client.customRequest('setDataBreakpoints', { breakpoints: [{ dataId }] });
      assert(placed.body.breakpoints[0].verified);
      for (const text of texts) {
        const stop = await stopped(client, () => client.continueRequest({ threadId: 1 }));
        assert.equal(stop.body.reason, 'data breakpoint');
        assert.match(stop.body.text, text);
        if (texts === onOff) {
          // The macro gives them back in its last statement, so that the section stands next.
          const [name, now] = text === onOff[0] ? ['macro SHOW', '0'] : ['section THREAD,AUTO', '1'];
          const frames = (await client.stackTraceRequest({ threadId: 1 })).body.stackFrames;
          assert.equal(frames[0].name, name);
          assert.equal(await value(client, 'POSTF(1,1,484)'), now);
        }
      }
      if (texts.length === 0) {
        // The script never sets this one: the run ends.
        await Promise.all([client.waitForEvent('terminated'), client.continueRequest({ threadId: 1 })]);
      }
    });
  }
  console.log('all sessions passed');
}

main().catch((error) => {
  console.error(error);
  process.exit(1);
});
