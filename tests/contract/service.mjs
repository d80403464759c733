// The released program with the process echo, on loopback with a data folder of its own; and requests
// to it, byte for byte as they are given.
import { spawn } from 'node:child_process';
import { mkdtempSync, openSync, readFileSync, rmSync } from 'node:fs';
import { request } from 'node:http';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

// ask('GET', url, { headers, body }): status, headers, the body as text and, where it is JSON, as that.
export const ask = (method, url, { headers = {}, body } = {}) =>
  new Promise((done, failed) => {
    const sent = request(url, { method, headers }, (response) => {
      const pieces = [];
      response.on('data', (piece) => pieces.push(piece));
      response.on('error', failed);
      response.on('end', () => {
        const bytes = Buffer.concat(pieces);
        const type = response.headers['content-type'] ?? '';
        const text = bytes.toString('utf8');
        const json = /^[^;]*[/+]json/.test(type) && text ? JSON.parse(text) : undefined;
        done({
          method, url, status: response.statusCode, version: response.httpVersion,
          headers: response.headers, type: type.split(';')[0].trim(), bytes, text, json,
        });
      });
    });
    sent.on('error', failed);
    sent.end(body);
  });

export const postJson = (url, body, headers = {}) =>
  ask('POST', url, {
    headers: { 'content-type': 'application/json', accept: 'application/json', ...headers },
    body: typeof body === 'string' ? body : JSON.stringify(body),
  });

export const pause = (ms) => new Promise((done) => { setTimeout(done, ms); });

// The job's status once it has ended.
export const ended = async (location) => {
  for (;;) {
    const { json } = await ask('GET', location);
    if (['successful', 'failed', 'dismissed'].includes(json?.status)) return json;
    await pause(100);
  }
};

// In `folder`, which stays, or in one of its own.
export const startService = async (program, port, { kept, env = {} } = {}) => {
  const folder = kept ?? mkdtempSync(join(tmpdir(), 'contract-'));
  const log = join(folder, 'log');
  const out = openSync(log, 'w');
  const child = spawn(
    program,
    ['serve', '--listen', `127.0.0.1:${port}`, '--data', join(folder, 'data'), '--workers', '2'],
    {
      stdio: ['ignore', out, out],
      env: {
        ...process.env, FARHORIZON_CONFORMANCE_ECHO: 'on', FARHORIZON_LOG_FORMAT: 'json', ...env,
      },
    },
  );
  const ends = new Promise((done) => { child.on('exit', done); });
  const stop = async () => {
    child.kill('SIGTERM');
    await ends;
    if (!kept) rmSync(folder, { recursive: true, force: true });
  };
  const kill = async () => {
    child.kill('SIGKILL');
    await ends;
  };
  for (let tries = 0; tries < 400 && child.exitCode === null; ++tries) {
    const found = /"msg":"serving".*?"url":"(http:[^"]+)"/.exec(readFileSync(log, 'utf8'));
    if (found) return { base: found[1], stop, kill, log };
    await pause(50);
  }
  const said = readFileSync(log, 'utf8');
  await stop();
  throw new Error(`the service does not listen: ${said}`);
};
