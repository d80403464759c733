// Resumable uploads by tus-js-client, the client that browsers have: in one piece and in many, cut
// off by a proxy and by kill -9, gone on with by a client that knows the URL alone; and the job is
// that of the same bytes in one POST.
import { mkdtempSync, rmSync } from 'node:fs';
import { createServer, connect } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { ask, ended, pause, postJson, startService } from './service.mjs';
import { claim, expect, same } from './verdict.mjs';

const kMebibyte = 1 << 20;

// A grid of text whose numbers have many digits: a DEM of few posts and `bytes` bytes.
const paddedGrid = (bytes) => {
  const columns = 60;
  const rows = 50;
  const lines = [`ncols ${columns}`, `nrows ${rows}`, 'xllcorner 7', 'yllcorner 46', 'cellsize 0.001'];
  const pad = Math.max(0, Math.floor(bytes / (columns * rows)) - 4);
  for (let y = 0; y < rows; ++y) {
    lines.push(Array.from({ length: columns }, (_, x) =>
      `${Math.round(500 + 40 * Math.sin(x / 3) + 30 * Math.cos(y / 4 + x / 7))}${' '.repeat(pad)}`).join(''));
  }
  return Buffer.from(`${lines.join('\n')}\n`);
};

// A proxy that passes on `most` bytes of what the client sends, then breaks both connections; after
// that all.
const cuttingProxy = async (target, most) => {
  let left = most;
  const server = createServer((client) => {
    const service = connect(target.port, target.hostname);
    const end = () => { client.destroy(); service.destroy(); };
    let cut = false;
    client.on('data', (piece) => {
      if (cut) return;
      service.write(piece.subarray(0, left));
      left -= piece.length;
      if (left > 0) return;
      cut = true;
      left = Infinity;
      setTimeout(end, 50);
    });
    service.on('data', (piece) => client.write(piece));
    for (const side of [client, service]) {
      side.on('error', end);
      side.on('close', end);
    }
  });
  await new Promise((done) => { server.listen(0, '127.0.0.1', done); });
  return { base: `http://127.0.0.1:${server.address().port}`, close: () => server.close() };
};

export const checkUploads = async (run) => {
  const { base, document, program } = run;
  const tus = run.packages('tus-js-client');
  // Ends with the upload's URL; `options` are those of tus-js-client.
  const send = (bytes, options) => new Promise((done, failed) => {
    const upload = new tus.Upload(bytes, {
      endpoint: `${base}/uploads`,
      retryDelays: null,
      metadata: { filename: 'hills.asc', filetype: 'text/plain' },
      onError: failed,
      onSuccess: () => done(upload.url),
      ...options,
    });
    upload.start();
  });
  const hashesOf = async (location) => {
    const status = await ended(location);
    same(status.status, 'successful', `the job (${status.message})`);
    const { json } = await ask('GET', `${location}/results`);
    return Object.fromEntries(Object.entries(json).map(([name, { sha256 }]) => [name, sha256]));
  };
  const parameters = { crs: 'EPSG:4326', levels: 2, formats: ['drc'] };
  const jobOf = async (url, service = base) => {
    const answer = await postJson(`${service}/jobs`, { inputs: { dem: { href: url }, ...parameters } });
    same(answer.status, 201, `the job's POST (${answer.text.slice(0, 300)})`);
    return answer.headers.location;
  };
  const head = (url) => ask('HEAD', url, { headers: { 'tus-resumable': '1.0.0' } });

  const dem = paddedGrid(40 * kMebibyte);
  let plain;
  await claim('uploads: 40 MiB in one POST, to compare with', async () => {
    const posted = await ask('POST', `${base}/jobs?crs=EPSG:4326&levels=2&formats=drc&filename=hills.asc`, {
      headers: { 'content-type': 'text/plain' }, body: dem,
    });
    same(posted.status, 201, 'the status');
    plain = await hashesOf(posted.headers.location);
    return `${dem.length} bytes`;
  });
  const sameJob = async (url, service) =>
    same(await hashesOf(await jobOf(url, service)), plain, 'the artifacts');

  await claim('uploads: OPTIONS, HEAD, GET and errors are what the document says', async () => {
    const fields = { 'tus-resumable': '1.0.0' };
    const hold = async (...request) => {
      const answer = await ask(...request);
      document.hold(answer);
      same(answer.headers['tus-resumable'], '1.0.0', 'Tus-Resumable of every answer');
      return answer;
    };
    const options = await hold('OPTIONS', `${base}/uploads`);
    same(options.headers['tus-version'], '1.0.0', 'Tus-Version');
    same((await hold('POST', `${base}/uploads`)).status, 412, 'no version');
    same((await hold('POST', `${base}/uploads`, { headers: fields })).status, 400, 'no length');
    const large = { ...fields, 'upload-length': String(2 ** 53) };
    same((await hold('POST', `${base}/uploads`, { headers: large })).status, 413, 'too large');
    const made = await hold('POST', `${base}/uploads`, { headers: { ...fields, 'upload-length': '5' } });
    same(made.status, 201, 'made');
    const url = made.headers.location;
    const patch = { ...fields, 'content-type': 'application/offset+octet-stream' };
    const piece = (offset, body, more) =>
      hold('PATCH', url, { headers: { ...patch, 'upload-offset': String(offset), ...more }, body });
    same((await piece(2, 'abc')).status, 409, 'a wrong offset');
    same((await piece(0, 'abcdef')).status, 413, 'beyond the length');
    same((await piece(0, 'abc', { 'content-type': 'text/plain' })).status, 415, 'a wrong type');
    same((await piece(0, 'abc', { 'upload-checksum': 'sha1 qvTGHdzF6KLavt4PO0gs2a6pQ00=' })).status,
         460, 'another checksum');
    same((await piece(0, 'hello', { 'upload-checksum': 'sha1 qvTGHdzF6KLavt4PO0gs2a6pQ00=' })).status,
         204, 'its checksum');
    same((await hold('GET', url)).json.complete, true, 'complete');
    same((await head(url)).headers['upload-offset'], '5', 'the offset');
    same((await hold('DELETE', url, { headers: fields })).status, 204, 'removal');
    same((await hold('DELETE', url, { headers: fields })).status, 404, 'again');
  });
  await claim('uploads: 40 MiB in one PATCH', async () => {
    const started = Date.now();
    const url = await send(dem, {});
    const took = Date.now() - started;
    await sameJob(url);
    return `${took} ms`;
  });
  await claim('uploads: 40 PATCHes of 1 MiB each', async () => {
    const started = Date.now();
    const url = await send(dem, { chunkSize: kMebibyte });
    const took = Date.now() - started;
    await sameJob(url);
    return `${took} ms`;
  });
  await claim('uploads: the first bytes with the POST, the length with the last, PATCH as POST', async () => {
    const part = dem.subarray(0, 3 * kMebibyte);
    const whole = await send(part, { uploadDataDuringCreation: true, chunkSize: kMebibyte });
    same((await head(whole)).headers['upload-offset'], String(part.length), 'the offset');
    const { Readable } = await import('node:stream');
    const late = await send(Readable.from([part]), { uploadLengthDeferred: true, chunkSize: kMebibyte });
    same((await head(late)).headers['upload-length'], String(part.length), 'the length');
    const posted = await send(part, { overridePatchMethod: true });
    same((await head(posted)).headers['upload-offset'], String(part.length), 'by POST');
  });
  await claim('uploads: cut off by the network, gone on with by a client that has the URL', async () => {
    const made = await ask('POST', `${base}/uploads`,
                           { headers: { 'tus-resumable': '1.0.0', 'upload-length': String(dem.length) } });
    const url = made.headers.location;
    const proxy = await cuttingProxy(new URL(base), 15 * kMebibyte);
    await send(dem, { uploadUrl: proxy.base + new URL(url).pathname })
      .then(() => { throw new Error('it was not cut off'); }, () => {});
    proxy.close();
    let at = 0;
    for (let tries = 0; tries < 100 && at < 14 * kMebibyte; ++tries) {
      await pause(100);  // the service has yet to see the end of the connection
      at = Number((await head(url)).headers['upload-offset']);
    }
    expect(at > 14 * kMebibyte, `${at} bytes are there of 15 MiB that went through`);
    await send(dem, { uploadUrl: url });
    await sameJob(url);
    return `gone on at ${at}`;
  });
  await claim('uploads: killed in the midst of a PATCH, gone on with after a start', async () => {
    const folder = mkdtempSync(join(tmpdir(), 'contract-'));
    let service = await startService(program, 0, { kept: folder });
    const { port } = new URL(service.base);
    try {
      let url;
      let killed;
      await send(dem, {
        endpoint: `${service.base}/uploads`,
        onAfterResponse(request, response) { url = response.getHeader('Location') ?? url; },
        onProgress(sent) {
          if (sent > 20 * kMebibyte) killed ??= service.kill();
        },
      }).then(() => { throw new Error('it was not cut off'); }, () => {});
      await killed;
      service = await startService(program, port, { kept: folder });
      const at = Number((await head(url)).headers['upload-offset']);
      await send(dem, { endpoint: `${service.base}/uploads`, uploadUrl: url });
      await sameJob(url, service.base);
      return `gone on at ${at}`;
    } finally {
      await service.stop();
      rmSync(folder, { recursive: true, force: true });
    }
  });
  await claim('uploads: a second client takes over from one whose connection hangs', async () => {
    const made = await ask('POST', `${base}/uploads`,
                           { headers: { 'tus-resumable': '1.0.0', 'upload-length': String(dem.length) } });
    const url = new URL(made.headers.location);
    const hanging = connect(url.port, url.hostname);
    hanging.on('error', () => {});
    hanging.write(`PATCH ${url.pathname} HTTP/1.1\r\nHost: ${url.host}\r\nTus-Resumable: 1.0.0\r\n` +
      `Upload-Offset: 0\r\nContent-Type: application/offset+octet-stream\r\nContent-Length: ${dem.length}\r\n\r\n`);
    hanging.write(dem.subarray(0, 3 * kMebibyte));
    const started = Date.now();
    await send(dem, { uploadUrl: url.href });
    const took = Date.now() - started;
    hanging.destroy();
    await sameJob(url.href);
    return `${took} ms`;
  });
  await claim('uploads: aborted and terminated', async () => {
    let url;
    const upload = new tus.Upload(dem, {
      endpoint: `${base}/uploads`, chunkSize: kMebibyte, retryDelays: null, onError() {},
    });
    await new Promise((done) => {
      upload.options.onProgress = (sent) => { if (sent > 2 * kMebibyte) done(); };
      upload.start();
    });
    ({ url } = upload);
    await upload.abort(true);
    same((await head(url)).status, 404, 'the status afterwards');
  });
  await claim('uploads: two jobs of one upload, and a job of the upload of nobody', async () => {
    const url = await send(dem, {});
    await sameJob(url);
    await sameJob(url);
    const answer = await postJson(`${base}/jobs`,
                                  { inputs: { dem: { href: '/uploads/01900000-0000-7000-8000-000000000001' } } });
    document.hold(answer);
    same([answer.status, answer.json.code], [404, 'no-such-upload'], 'the answer');
  });
};
