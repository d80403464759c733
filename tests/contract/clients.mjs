// Clients that others wrote: one that is generated from the served document, and OWSLib.
import { execFileSync } from 'node:child_process';
import { rmSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

import { packageOf } from './document.mjs';
import { claim, expect, same } from './verdict.mjs';

const generate = async (run) => {
  const { generate: write, HttpClient } = await packageOf(run, 'openapi-typescript-codegen');
  const { build } = await packageOf(run, 'esbuild');
  const folder = join(run.cache, 'generated');
  rmSync(folder, { recursive: true, force: true });
  await write({
    input: join(run.cache, 'served/openapi-3.0.json'), output: folder, httpClient: HttpClient.FETCH,
  });
  const bundle = join(folder, 'client.mjs');
  await build({
    entryPoints: [join(folder, 'index.ts')], outfile: bundle, bundle: true, format: 'esm',
    platform: 'node', logLevel: 'silent',
  });
  return import(pathToFileURL(bundle).href);
};

export const checkClients = async (run) => {
  await claim('clients: one generated from the document finds, runs and lists', async () => {
    const { DefaultService: api, OpenAPI } = await generate(run);
    OpenAPI.BASE = run.base;
    const landing = await api.getLandingPage();
    expect(landing.links.length > 0, 'no links');
    expect((await api.getConformance()).conformsTo.length > 0, 'no classes');
    const { processes } = await api.listProcesses(10);
    same(processes.map(({ id }) => id), ['terrain-lod', 'echo'], 'the processes');
    const { inputs } = await api.getProcess('echo');
    expect(inputs.text, 'no input text');
    const results = await api.execute('echo', {
      inputs: { text: 'from a generated client' }, response: 'document',
    });
    same(results.text, 'from a generated client', 'the result');
    expect((await api.listJobs(5)).jobs.length > 0, 'no jobs');
    await api.getProcess('none').then(
      () => { throw new Error('there is a process none'); },
      (wrong) => same([wrong.status, wrong.body?.code], [404, 'no-such-process'], 'the error'));
    return Object.getOwnPropertyNames(api).filter((name) => /^[a-z]/.test(name) &&
      !['length', 'name', 'prototype'].includes(name)).length + ' operations';
  });
  await claim('clients: OWSLib finds its way', () => {
    const said = execFileSync('/usr/bin/python3',
                              ['-B', join(run.root, 'tests/contract/owslib_client.py'), run.base],
                              { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
    return said.trim();
  });
};
