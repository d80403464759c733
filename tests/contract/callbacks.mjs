// Subscribers as the callbacks of proto/openapi.yaml have them, received and verified by others'
// code: node's server, and the library of Standard Webhooks.
import { randomBytes } from 'node:crypto';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import * as ogc from './ogc_schemas.mjs';
import { ask, ended, pause, postJson } from './service.mjs';
import { claim, expect, same } from './verdict.mjs';

const kPatienceMs = 20_000;

// A server that takes every call but the first, and the variables that let the service call it.
export const startReceiver = async () => {
  const folder = mkdtempSync(join(tmpdir(), 'contract-'));
  const file = join(folder, 'secret');
  const secret = `whsec_${randomBytes(32).toString('base64')}`;
  writeFileSync(file, `${secret}\n`, { mode: 0o400 });
  const calls = [];
  const server = createServer((request, response) => {
    const pieces = [];
    request.on('data', (piece) => pieces.push(piece));
    request.on('end', () => {
      calls.push({ path: request.url, headers: request.headers, body: Buffer.concat(pieces).toString() });
      response.writeHead(calls.length === 1 ? 503 : 204).end();
    });
  });
  await new Promise((done) => { server.listen(0, '127.0.0.1', done); });
  const url = `http://127.0.0.1:${server.address().port}/hook`;
  const stop = () => {
    server.close();
    rmSync(folder, { recursive: true, force: true });
  };
  return {
    url, secret, calls, stop,
    env: {
      FARHORIZON_CALLBACKS_ALLOW: url,
      FARHORIZON_CALLBACKS_ALLOW_PRIVATE_ADDRESSES: '127.0.0.1',
      FARHORIZON_CALLBACKS_SECRET_FILE: file,
    },
  };
};

export const checkCallbacks = async ({ base, document, packages }, receiver) => {
  const { Webhook } = packages('standardwebhooks');
  const webhook = new Webhook(receiver.secret);
  const subscriber = {
    successUri: `${receiver.url}/done`, inProgressUri: `${receiver.url}/begun`,
    failedUri: `${receiver.url}/failed`,
  };
  const echo = async (inputs, whom = subscriber) => {
    const answer = await postJson(`${base}/processes/echo/execution`,
                                  { inputs, subscriber: whom }, { prefer: 'respond-async' });
    document.hold(answer);
    return answer;
  };
  const callOf = async (path) => {
    for (let waited = 0; waited < kPatienceMs; waited += 50) {
      const found = receiver.calls.filter((one, at) => one.path === path && at > 0);
      if (found.length > 0) return found[0];
      await pause(50);
    }
    throw new Error(`no call of ${path}`);
  };
  await claim('callback: the class is listed where somebody may be called', async () => {
    const { json } = await ask('GET', `${base}/conformance`);
    expect(json.conformsTo.some((one) => one.endsWith('/conf/callback')), 'it is not');
  });
  await claim('callback: success posts the results document, signed, after a refusal too', async () => {
    const { headers: { location } } = await echo({ text: 'hi' });
    await ended(location);
    const call = await callOf('/hook/done');
    const said = webhook.verify(call.body, call.headers);
    document.validate(ogc.results, said, 'results');
    same(Object.values(said).every(({ href }) => href.startsWith(`${location}/results/`)), true,
         'that each is a link');
    const ids = receiver.calls.filter((one) => one.path === '/hook/done')
      .map((one) => one.headers['webhook-id']);
    same(new Set(ids).size, 1, 'the number of ids');
  });
  await claim('callback: a dismissed job posts its status to failedUri', async () => {
    const { headers: { location } } = await echo({ pause: 30 });
    same((await ask('DELETE', location)).status, 200, 'the status');
    const call = await callOf('/hook/failed');
    const said = webhook.verify(call.body, call.headers);
    document.validate(ogc.statusInfo, said, 'statusInfo');
    same(said.status, 'dismissed', 'the job');
  });
  await claim('callback: URLs that are not allowed are refused with a problem', async () => {
    for (const [whom, code] of [
      [{ successUri: 'http://169.254.169.254/hook' }, 'callback-not-allowed'],
      [{ successUri: `${receiver.url}/../x` }, 'callback-not-allowed'],
      [{ failedUri: receiver.url }, 'invalid-parameter'],
      [{ successUri: receiver.url, x: receiver.url }, 'invalid-parameter'],
      [{ successUri: 3 }, 'invalid-parameter'],
    ]) {
      same((await echo({ text: 'hi' }, whom)).json.code, code, JSON.stringify(whom));
    }
  });
};
