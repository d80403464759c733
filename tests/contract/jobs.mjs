// Jobs of terrain-lod by JSON: the same bytes as by the DEM itself, in every form of results.
import { createHash } from 'node:crypto';

import * as ogc from './ogc_schemas.mjs';
import { ask, ended, postJson } from './service.mjs';
import { claim, expect, same } from './verdict.mjs';

// Hills in degrees.
const grid = (columns, rows) => {
  const lines = [`ncols ${columns}`, `nrows ${rows}`, 'xllcorner 7', 'yllcorner 46', 'cellsize 0.001'];
  for (let y = 0; y < rows; ++y) {
    lines.push(Array.from({ length: columns }, (_, x) =>
      Math.round(500 + 40 * Math.sin(x / 3) + 30 * Math.cos(y / 4 + x / 7))).join(' '));
  }
  return `${lines.join('\n')}\n`;
};

export const checkJobs = async (run) => {
  const { base, document } = run;
  const dem = grid(40, 30);
  const inputs = {
    dem: Buffer.from(dem).toString('base64'), filename: 'hills.asc', crs: 'EPSG:4326', levels: 2,
  };
  const get = async (url, fields = {}) => {
    const answer = await ask('GET', url, { headers: fields });
    document.hold(answer);
    return answer;
  };
  const run1 = async (body, path = '/processes/terrain-lod/execution') => {
    const answer = await postJson(base + path, body);
    document.hold(answer);
    same(answer.status, 201, `the status (${answer.text.slice(0, 300)})`);
    const { location } = answer.headers;
    const status = await ended(location);
    same(status.status, 'successful', `the job (${status.message})`);
    document.validate(ogc.statusInfo, status, 'statusInfo');
    return location;
  };

  let plain;
  await claim('jobs: results without an execute request are links to all artifacts', async () => {
    const posted = await ask('POST', `${base}/jobs?crs=EPSG:4326&levels=2&filename=hills.asc`, {
      headers: { 'content-type': 'text/plain' }, body: dem,
    });
    document.hold(posted);
    same(posted.status, 201, 'the status');
    await ended(posted.headers.location);
    plain = (await get(`${posted.headers.location}/results`)).json;
    document.validate(ogc.results, plain, 'results');
    expect(Object.values(plain).every(({ href, sha256 }) => href && sha256), 'not links alone');
    return `${Object.keys(plain).length} artifacts`;
  });
  const hashes = (results) =>
    Object.fromEntries(Object.entries(results).map(([name, { sha256 }]) => [name, sha256]));
  await claim('jobs: the DEM in base64 makes the same bytes', async () => {
    const location = await run1({ inputs });
    same(hashes((await get(`${location}/results`)).json), hashes(plain), 'the artifacts');
    for (const { href, sha256, length } of Object.values(plain)) {
      const { bytes } = await get(href);
      same([bytes.length, createHash('sha256').update(bytes).digest('hex')], [length, sha256], href);
    }
  });
  await claim('jobs: an execute request at POST /jobs, values with their format', async () => {
    const qualified = {
      ...inputs,
      dem: { value: inputs.dem.replace(/.{76}/g, '$&\r\n'), mediaType: 'text/plain', encoding: 'base64' },
      levels: { value: 2 },
    };
    const location = await run1({ process: 'terrain-lod', inputs: qualified }, '/jobs');
    same(hashes((await get(`${location}/results`)).json), hashes(plain), 'the artifacts');
  });
  await claim('jobs: one output is its bytes, with ranges and a tag', async () => {
    const location = await run1({ inputs, outputs: { 'lod0.glb': {} } });
    const answer = await get(`${location}/results`);
    same([answer.status, answer.type], [200, 'model/gltf-binary'], 'the answer');
    same(createHash('sha256').update(answer.bytes).digest('hex'), plain['lod0.glb'].sha256, 'hash');
    const part = await ask('GET', `${location}/results`, { headers: { range: 'bytes=0-3' } });
    same([part.status, part.text], [206, 'glTF'], 'a part');
    const again = await ask('GET', `${location}/results`,
                            { headers: { 'if-none-match': answer.headers.etag } });
    same(again.status, 304, 'the status with the tag');
  });
  await claim('jobs: a document of values and links', async () => {
    const location = await run1({
      inputs,
      response: 'document',
      outputs: {
        'report.json': { transmissionMode: 'value' },
        'lod0.drc': { transmissionMode: 'value' },
        'lod1.drc': {},
      },
    });
    const { json } = await get(`${location}/results`);
    document.validate(ogc.results, json, 'results');
    same(Object.keys(json), ['lod0.drc', 'lod1.drc', 'report.json'], 'the outputs');
    same(json['report.json'].value.levels.length, 2, 'the levels of the report');
    const bytes = Buffer.from(json['lod0.drc'].value, json['lod0.drc'].encoding);
    same(createHash('sha256').update(bytes).digest('hex'), plain['lod0.drc'].sha256, 'hash');
    same(json['lod1.drc'].sha256, plain['lod1.drc'].sha256, 'the link');
    const beyond = await postJson(`${base}/jobs`, { inputs, outputs: { 'lod7.drc': {} } });
    same(beyond.status, 400, 'a level that was not asked for');
  });
  await claim('jobs: raw, all by reference', async () => {
    const location = await run1({ inputs, response: 'raw' });
    const answer = await get(`${location}/results`);
    same(answer.status, 204, 'the status');
    same(answer.headers.link.split(', <').length, Object.keys(plain).length, 'the links');
  });
  await claim('jobs: all artifacts in one archive', async () => {
    const location = await run1({ inputs });
    const tar = await get(`${location}/results?f=tar`);
    same([tar.status, tar.type, tar.text.slice(257, 262)], [200, 'application/x-tar', 'ustar'], 'tar');
    const zip = await get(`${location}/results?f=zip`);
    same([zip.status, zip.type, zip.text.slice(0, 2)], [200, 'application/zip', 'PK'], 'zip');
    same((await get(`${location}/results?f=rar`)).status, 400, 'rar');
    return `${tar.bytes.length} and ${zip.bytes.length} bytes`;
  });
  await claim('jobs: events and a long poll follow a job to its end', async () => {
    const posted = await postJson(`${base}/jobs`, { inputs: { ...inputs, levels: 1 } });
    const { location } = posted.headers;
    const stream = (await get(`${location}/events`)).text;
    const events = stream.split('\n\n').filter((event) => event.includes('event: status'));
    const statuses = events.map((event) => JSON.parse(/^data: (.*)$/m.exec(event)[1]));
    for (const status of statuses) document.validate(ogc.statusInfo, status, 'statusInfo');
    same(statuses.at(-1).status, 'successful', 'the last');
    const id = /^id: (.*)$/m.exec(events.at(-1))[1];
    same((await get(`${location}/events`, { 'last-event-id': id })).status, 204, 'resumed');
    const poll = await get(location, { prefer: 'wait=30' });
    same([poll.headers.etag, poll.headers['preference-applied']], [`"${id}"`, 'wait=30'], 'the poll');
    return `${events.length} events`;
  });
  await claim('jobs: a failed job answers with why', async () => {
    const answer = await postJson(`${base}/jobs`, { inputs: { ...inputs, workBudget: 1 } });
    document.hold(answer);
    const status = await ended(answer.headers.location);
    same([status.status, status.exception.code], ['failed', 'work-budget'], 'the job');
    const results = await get(`${answer.headers.location}/results`);
    same([results.status, results.json.code], [422, 'work-budget'], 'the results');
    expect(status.links.some(({ rel }) => rel.endsWith('/exceptions')), 'no link to the exception');
  });
  await claim('jobs: a DEM of 32 MiB in base64 costs the service no memory for it', async () => {
    // It begins as a TIFF does, so that it is taken whole before it is refused.
    const raster = Buffer.alloc(32 << 20, 0x20);
    raster.write('II*\0', 'latin1');
    const large = raster.toString('base64');
    const body = JSON.stringify({ inputs: { dem: large } });
    const before = await memoryOf(base);
    const answers = await Promise.all([1, 2, 3].map(() => postJson(`${base}/jobs`, body)));
    for (const { status } of answers) expect(status >= 400 && status < 500, `status ${status}`);
    const grown = (await memoryOf(base)) - before;
    expect(grown < (16 << 20), `grew by ${grown} bytes`);
    return `resident memory grew by ${Math.round(grown / 1024)} KiB`;
  });
};

const memoryOf = async (base) => {
  const { text } = await ask('GET', `${base}/metrics`);
  return Number(/^process_resident_memory_bytes (\S+)/m.exec(text)[1]);
};
