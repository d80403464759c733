// The document of the API as it is served, and answers held to it.
import { execFileSync } from 'node:child_process';
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

import { ask } from './service.mjs';
import { claim, expect, same } from './verdict.mjs';

const lint = (run, file) => {
  const config = join(run.root, 'tests/contract/redocly.yaml');
  const program = join(run.cache, 'node_modules/.bin/redocly');
  try {
    execFileSync(program, ['lint', '--config', config, '--format', 'stylish', file], {
      encoding: 'utf8',
      stdio: ['ignore', 'pipe', 'pipe'],
      env: { ...process.env, REDOCLY_TELEMETRY: 'off', REDOCLY_SUPPRESS_UPDATE_NOTICE: 'true' },
    });
  } catch (wrong) {
    throw new Error(`${wrong.stdout ?? ''}${wrong.stderr ?? ''}`.trim().slice(0, 4000));
  }
};

export const packageOf = async (run, name) =>
  import(pathToFileURL(run.packages.resolve(name)).href);

export const checkDocument = async (run) => {
  const { default: SwaggerParser } = await packageOf(run, '@apidevtools/swagger-parser');
  const folder = join(run.cache, 'served');
  mkdirSync(folder, { recursive: true });
  const forms = {};
  for (const version of ['3.0', '3.1']) {
    const served = await ask('GET', `${run.base}/api?v=${version}`);
    forms[version] = join(folder, `openapi-${version}.json`);
    writeFileSync(forms[version], served.text);
    await claim(`document: ${version} has its media type`, () =>
      same(served.headers['content-type'], `application/vnd.oai.openapi+json;version=${version}`,
           'Content-Type'));
  }
  for (const [name, file] of Object.entries(forms)) {
    await claim(`document: redocly lints ${name}`, () => lint(run, file));
    await claim(`document: swagger-parser reads ${name}`, () => SwaggerParser.validate(file));
  }
};

// A check of answers against the served document: its paths, statuses, media types and schemas.
export const documentOf = async (run) => {
  const { default: SwaggerParser } = await packageOf(run, '@apidevtools/swagger-parser');
  const { default: Ajv } = await packageOf(run, 'ajv/dist/2020.js');
  const { default: formats } = await packageOf(run, 'ajv-formats');
  const ajv = new Ajv({ strict: false, allErrors: true });
  (formats.default ?? formats)(ajv);
  const served = await ask('GET', `${run.base}/api`);
  const api = await SwaggerParser.dereference(served.json);
  const operations = Object.entries(api.paths).flatMap(([path, item]) =>
    ['get', 'post', 'patch', 'delete', 'options'].filter((method) => item[method]).map((method) => ({
      method: method.toUpperCase(),
      pattern: new RegExp(
        `^${path.replaceAll('.', '\\.').replace(/\{[^}]*\*\}/, '.+').replace(/\{[^}]*\}/g, '[^/]+')}$`),
      operation: item[method],
    })));

  const validate = (schema, value, what) => {
    const check = ajv.compile(schema);
    expect(check(value), `${what}: ${ajv.errorsText(check.errors).slice(0, 500)}`);
  };
  // Throws where an answer is not what the document says of its operation.
  const hold = (answer) => {
    const { pathname } = new URL(answer.url);
    const found = operations.find(({ method, pattern }) =>
      method === answer.method && pattern.test(pathname));
    const what = `${answer.method} ${pathname}`;
    if (!found) {
      expect([404, 405].includes(answer.status), `${what} is in no path of the document`);
      return;
    }
    const { responses } = found.operation;
    const response = responses[answer.status] ?? responses[`${String(answer.status)[0]}XX`];
    expect(response, `${what} answered ${answer.status}, which the document does not list`);
    if (!answer.bytes.length) return;
    const { content = {} } = response;
    const media = content[answer.type] ?? content[answer.headers['content-type']] ?? content['*/*'];
    expect(media, `${what} answered ${answer.type}, which the document does not list`);
    if (answer.json !== undefined && media.schema) {
      validate(media.schema, answer.json, `${what} against the document`);
    }
  };
  return { api, hold, validate };
};
