// Every assertion of OGC's test suite, ets-ogcapi-processes10, under the name of its test method, as
// its requests would go out: the same inputs, fields and questions, made from the process description.
import { randomUUID } from 'node:crypto';

import * as ogc from './ogc_schemas.mjs';
import { ask, ended, pause, postJson } from './service.mjs';
import { claim, expect, same, skipped } from './verdict.mjs';

const kText = 'teststring';
const kRelations = 'http://www.opengis.net/def/rel/ogc/1.0/';
const kExceptions = 'http://www.opengis.net/def/exceptions/ogcapi-processes-1/1.0/';
// A TIFF of one pixel.
const kTiff = Buffer.from(
  '49492a000800000008000001030001000000010000000101030001000000010000000201030001000000080000000301' +
  '03000100000001000000060103000100000001000000110104000100000070000000150103000100000001000000' +
  '170104000100000001000000000000000000', 'hex').toString('base64');

const json = { headers: { accept: 'application/json' } };

// The inputs and outputs of the echo as the suite reads them out of its description.
const readEcho = (description) => {
  const isBox = (schema) => (schema.allOf ?? []).some(({ format }) => format === 'ogc-bbox') ||
    (schema.type === 'object' && schema.properties?.bbox);
  const inputs = Object.entries(description.inputs).map(([id, { schema }]) => ({
    id,
    schema,
    box: isBox(schema),
    plainText: schema.type === 'string' && !schema.format && !schema.contentMediaType,
    object: schema.type === 'object' && !isBox(schema),
    binary: schema.contentMediaType !== undefined,
    array: schema.type === 'array',
  }));
  const outputs = Object.entries(description.outputs).map(([id, { schema }]) => ({
    id, box: isBox(schema), array: schema.type === 'array',
  }));
  return { inputs, outputs };
};

export const checkEts = async (run) => {
  const { base, document } = run;
  const get = async (url, how = json) => {
    const answer = await ask('GET', url, how);
    document.hold(answer);
    return answer;
  };
  const description = (await get(`${base}/processes/echo`)).json;
  const { inputs, outputs } = readEcho(description);

  const all = (chosen) =>
    Object.fromEntries(chosen.map(({ id }) => [id, { transmissionMode: 'value' }]));
  // Beside what a test is about, the suite sends texts and objects.
  const basic = () => Object.fromEntries([
    ...inputs.filter((one) => one.plainText).map(({ id }) => [id, kText]),
    ...inputs.filter((one) => one.object).map(({ id }) => [id, { value: kText }]),
  ]);
  const request = (more = {}) => ({ inputs: basic(), outputs: all(outputs), ...more });
  const endpoint = `${base}/processes/echo/execution`;
  const send = async (body, fields = {}) => {
    const answer = await postJson(endpoint, body, fields);
    document.hold(answer);
    return answer;
  };
  const async = (body, field = 'respond-async') => send(body, { prefer: field });
  const created = (answer) => {
    same(answer.status, 201, 'the status');
    expect(answer.headers.location?.startsWith(`${base}/jobs/`),
           `Location is ${answer.headers.location}`);
    return answer.headers.location;
  };
  const statusOf = async (location) => {
    const answer = await get(location);
    same(answer.status, 200, 'the status');
    document.validate(ogc.statusInfo, answer.json, 'statusInfo');
    return answer.json;
  };
  const partWith = (answer) => {
    expect(answer.type === 'multipart/related', `Content-Type is ${answer.type}`);
    const boundary = answer.text.slice(2, answer.text.indexOf('\r\n'));
    const parts = answer.text.split(`--${boundary}`).slice(1, -1);
    expect(parts.length > 0 && parts.some((part) => part.includes(kText)), 'no part has the text');
    expect(answer.text.endsWith(`--${boundary}--\r\n`), 'no closing boundary');
  };
  const succeeds = (name, body) => claim(`ets: ${name}`, async () => {
    const answer = await send(body);
    same(answer.status, 200, 'the status');
    return `${answer.status} ${answer.type}`;
  });
  // Follows the links of a status as the suite does: results where there are some, else monitor.
  const loopOverStatus = async (status, left = 4) => {
    expect(left > 0, 'no result in 20 seconds');
    const results = status.links.find(({ rel }) => rel === `${kRelations}results`);
    if (results) {
      const answer = await ask('GET', results.href);
      document.hold(answer);
      expect(answer.text.includes(kText), `the results lack the text: ${answer.text.slice(0, 200)}`);
      return;
    }
    const monitor = status.links.find(({ rel }) => rel === 'monitor' || rel === 'status');
    expect(monitor, 'neither results nor monitor among the links');
    await pause(left === 4 ? 300 : 5000);
    await loopOverStatus((await get(monitor.href)).json, left - 1);
  };

  // GeneralHttp, LandingPage, Conformance
  await claim('ets: testHttp', async () => same((await get(`${base}/`)).version, '1.1', 'HTTP'));
  await claim('ets: testLandingPageRetrieval', async () =>
    same((await get(`${base}/`)).status, 200, 'the status'));
  await claim('ets: testLandingPageValidation', async () => {
    const { json: landing } = await get(`${base}/`);
    document.validate(ogc.landingPage, landing, 'landingPage');
    const relations = new Set(landing.links.map(({ rel }) => rel));
    for (const rel of ['service-desc', `${kRelations}conformance`, `${kRelations}processes`]) {
      expect(relations.has(rel), `no link ${rel}`);
    }
  });
  await claim('ets: testValidateConformanceOperationAndResponse', async () => {
    const answer = await get(`${base}/conformance`);
    same(answer.status, 200, 'the status');
    document.validate(ogc.confClasses, answer.json, 'confClasses');
    const kept = answer.json.conformsTo;
    const prefix = 'http://www.opengis.net/spec/ogcapi-processes-1/1.0/conf/';
    for (const name of ['core', 'ogc-process-description', 'json', 'oas30', 'job-list', 'dismiss']) {
      expect(kept.includes(prefix + name), `no class ${name}`);
    }
    expect(!kept.some((uri) => /html|ogcapi-processes-[34]/.test(uri)), 'claims too much');
  });

  // ProcessList
  const list = `${base}/processes`;
  await claim('ets: testPlLimitDefinition', () => {
    const limit = run.document.api.paths['/processes'].get.parameters
      .find(({ name }) => name === 'limit');
    same([limit.in, limit.required ?? false, limit.schema],
         ['query', false, { type: 'integer', minimum: 1, maximum: 10000, default: 10 }], 'limit');
  });
  await claim('ets: testPlLimitResponse', async () =>
    same((await get(`${list}?limit=1`)).json.processes.length, 1, 'the number of processes'));
  await claim('ets: testPlLinks', async () =>
    expect(Array.isArray((await get(`${list}?limit=1`)).json.links), 'no links'));
  await claim('ets: testProcessList', async () =>
    expect((await get(list)).json.processes.length > 0, 'no processes'));
  await claim('ets: testProcessListSuccess', async () =>
    document.validate(ogc.processList, (await get(list)).json, 'processList'));

  // Process
  await claim('ets: testProcessExceptionNoSuchProcess', async () => {
    const answer = await get(`${list}/invalid-process-${randomUUID()}`);
    same(answer.status, 404, 'the status');
    same(answer.json.type, `${kExceptions}no-such-process`, 'the type');
    document.validate(ogc.exception, answer.json, 'exception');
  });
  for (const name of ['testProcess', 'testProcessSuccess']) {
    await claim(`ets: ${name}`, async () => {
      const answer = await get(`${list}/echo`);
      same(answer.headers['content-type'], 'application/json', 'Content-Type');
      document.validate(ogc.process, answer.json, 'process');
    });
  }

  // OGCProcessDescription, of all processes
  const descriptions = [];
  await claim('ets: testOGCProcessDescriptionJSON', async () => {
    for (const { id } of (await get(list)).json.processes) {
      const answer = await get(`${list}/${id}`);
      document.validate(ogc.process, answer.json, id);
      descriptions.push(answer.json);
    }
    expect(descriptions.length === 2, 'not both processes');
  });
  await claim('ets: testOGCProcessDescriptionInputsDef', () =>
    expect(descriptions.every((one) => Object.keys(one.inputs).length > 0), 'no inputs'));
  await claim('ets: testOGCProcessDescriptionInputDef', () =>
    expect(descriptions.every((one) => Object.values(one.inputs).every(({ schema }) => schema)),
           'an input without a schema'));
  await claim('ets: testOGCProcessDescriptionInputDefinitionOfMixedType', () => {
    const mixed = descriptions.flatMap((one) => Object.values(one.inputs))
      .filter(({ schema }) => schema.oneOf);
    expect(mixed.every(({ schema }) => schema.oneOf.every((one) => one.type)), 'a kind without type');
    return `${mixed.length} inputs of several kinds`;
  });
  await claim('ets: testOGCProcessDescriptionOutputsDef', () =>
    expect(descriptions.every((one) => Object.keys(one.outputs).length > 0), 'no outputs'));
  await claim('ets: testOGCProcessDescriptionOutputDef', () =>
    expect(descriptions.every((one) => Object.values(one.outputs).every(({ schema }) => schema)),
           'an output without a schema'));

  // Jobs: creation
  await claim('ets: testJobCreationAutoExecutionMode', async () => {
    created(await async(request()));
  });
  await claim('ets: testJobCreationDefaultExecutionMode', async () =>
    same((await send(request())).status, 200, 'the status'));
  const { outputs: unused, ...withoutOutputs } = request();
  await succeeds('testJobCreationDefaultOutputs', withoutOutputs);
  const array = inputs.find((one) => one.array);
  await succeeds('testJobCreationInputArray', {
    inputs: { ...basic(), [array.id]: [1, 2, 3] },
    outputs: all(outputs.filter((one) => one.array)),
  });
  const box = inputs.find((one) => one.box);
  await succeeds('testJobCreationInputInlineBbox', {
    inputs: {
      ...basic(),
      [box.id]: {
        bbox: [51.9, 7, 52, 7.1], crs: 'http://www.opengis.net/def/crs/OGC/1.3/CRS84',
      },
    },
    outputs: all(outputs.filter((one) => one.box)),
  });
  await succeeds('testJobCreationInputInlineBbox, as other tests send a box', {
    ...request(),
    inputs: {
      ...basic(),
      [box.id]: {
        bbox: [345345345, 345345345, 345345345, 345345345], crs: 'urn:ogc:def:crs:EPSG:6.6:4326',
      },
    },
  });
  const picture = inputs.find((one) => one.binary);
  await succeeds('testJobCreationInputInlineBinary', {
    ...request(),
    inputs: {
      ...basic(),
      [picture.id]: {
        value: kTiff, format: { mediaType: picture.schema.contentMediaType, encoding: 'base64' },
      },
    },
  });
  await succeeds('testJobCreationInputInlineMixed', request());
  await succeeds('testJobCreationInputInlineObject', request());
  await succeeds('testJobCreationInputInline', request());
  await succeeds('testJobCreationInputs', request());
  await succeeds('testJobOp', request());
  // The suite sends links to inputs that it takes for binary: of format byte or of the encoding
  // binary. There is none, so it sends its texts and objects.
  await claim('ets: testJobCreationInputRef', async () => {
    const sent = inputs.some(({ schema }) => schema.format === 'byte' ||
      schema.contentEncoding === 'binary');
    expect(!sent, 'the suite would send a link');
    partWith(await send(request()));
  });
  await claim('a link as an input is refused, whatever it leads to', async () => {
    for (const href of ['http://127.0.0.1:1/', 'file:///etc/passwd', 'http://[::1]/', 'x']) {
      const answer = await send({ inputs: { [picture.id]: { href } } });
      same([answer.status, answer.json.code], [403, 'href-not-allowed'], 'the answer');
    }
  });
  await claim('ets: testJobCreationInputValidation', async () => {
    partWith(await send(request()));
    const wrong = Object.fromEntries(inputs.filter((one) => one.binary)
      .map(({ id }) => [id, { type: `wrong/type_${randomUUID()}` }]));
    expect(Object.keys(wrong).length > 0, 'no input with a format');
    const answer = await send({ ...request(), inputs: { ...basic(), ...wrong } });
    expect([400, 500].includes(answer.status), `the status is ${answer.status}`);
    expect(/^application\/json($|;)/.test(answer.headers['content-type']),
           `Content-Type is ${answer.headers['content-type']}`);
    document.validate(ogc.exception, answer.json, 'exception');
    return `${answer.status} ${answer.json.code}`;
  });
  await claim('RFC 9457: who does not ask for plain JSON gets application/problem+json', async () => {
    for (const accept of ['*/*', 'application/problem+json', 'application/json, */*;q=0.1']) {
      const answer = await send({ inputs: [] }, { accept });
      same(answer.type, 'application/problem+json', `Content-Type for ${accept}`);
    }
  });
  await claim('ets: testJobCreationOp', async () => {
    await statusOf(created(await async(request(), 'respond-async ')));
  });
  for (const name of ['testJobCreationRequest', 'testJobCreationSuccessAsync', 'testJobResults',
                      'testJobResultsAsyncRawMixedMulti', 'testJobResultsAsyncRawRef',
                      'testJobResultsAsyncRawValueMulti']) {
    await claim(`ets: ${name}`, async () => {
      await statusOf(created(await async(request())));
    });
  }
  await claim('ets: testJobSuccess', async () => {
    await statusOf(created(await async(request(), 'respond-async ')));
  });
  await claim('ets: testJobCreationSyncDocument', async () => {
    const answer = await send(request({ response: 'document' }));
    same(answer.status, 200, 'the status');
    document.validate(ogc.results, answer.json, 'results');
    same(answer.json[inputs[0].id], kText, 'the first output');
  });
  for (const name of ['testJobCreationSyncRawMixedMulti', 'testJobCreationSyncRawRef',
                      'testJobCreationSyncRawValueMulti']) {
    await claim(`ets: ${name}`, async () => {
      const answer = await send(request({ response: 'raw' }));
      same(answer.status, 200, 'the status');
      partWith(answer);
    });
  }
  const first = inputs[0].id;
  const one = { ...request({ response: 'raw' }), outputs: all([{ id: first }]) };
  await claim('ets: testJobCreationSyncRawValueOne', async () => {
    const answer = await send(one);
    same([answer.status, answer.text], [200, kText], 'the answer');
  });

  // Jobs: status and results
  const nobody = `${base}/jobs/invalid-job-${randomUUID()}`;
  for (const [name, url] of [['testJobExceptionNoSuchJob', nobody],
                             ['testJobResultsNoSuchJob', `${nobody}/results`]]) {
    await claim(`ets: ${name}`, async () => {
      const answer = await get(url);
      same([answer.status, answer.json.type], [404, `${kExceptions}no-such-job`], 'the answer');
      document.validate(ogc.exception, answer.json, 'exception');
    });
  }
  await claim('ets: testJobResultsExceptionResultsNotReady', async () => {
    expect(inputs.some(({ id }) => id === 'pause'), 'no input pause');
    const location = created(await async({
      inputs: { [first]: kText, pause: 5 }, outputs: all([{ id: first }]), response: 'raw',
    }));
    await get(location);
    const answer = await get(`${location}/results`);
    same([answer.status, answer.json.type], [404, `${kExceptions}result-not-ready`], 'the answer');
    document.validate(ogc.exception, answer.json, 'exception');
    await ask('DELETE', location);
  });
  await claim('ets: testJobResultsFailed', async () => {
    const answer = await send({ 'invalid-execute-request': 'true)' });
    expect(answer.status > 200, `the status is ${answer.status}`);
    document.validate(ogc.exception, answer.json, 'exception');
    return `${answer.status} ${answer.json.code}`;
  });
  await claim('ets: testJobResultsAsyncDocument', async () => {
    const location = created(await async(request({ response: 'document' })));
    const status = await ended(location);
    same(status.status, 'successful', 'the job');
    const answer = await get(`${location}/results`);
    document.validate(ogc.results, answer.json, 'results');
  });
  await claim('ets: testJobResultsAsyncRawValueOne', async () => {
    await loopOverStatus(await statusOf(created(await async(one))));
  });
  await claim('ets: testJobResultsSync', async () => {
    const answer = await send(request());
    same(answer.status, 200, 'the status');
    expect(answer.headers.link === undefined, `there is a Link: ${answer.headers.link}`);
  });
  await claim('results in parts, as the asynchronous tests leave them unread', async () => {
    await loopOverStatus(await statusOf(created(await async(request()))));
  });
  await claim('results by reference: 204 and a Link to each', async () => {
    const location = created(await async({
      inputs: basic(), outputs: { [first]: { transmissionMode: 'reference' } }, response: 'raw',
    }));
    await ended(location);
    const answer = await get(`${location}/results`);
    same(answer.status, 204, 'the status');
    const [, href] = /^<([^>]+)>/.exec(answer.headers.link);
    same((await ask('GET', href)).text, kText, 'what the link leads to');
  });

  // JobList
  await claim('ets: testJobList', async () =>
    expect((await get(`${base}/jobs`)).json.jobs.length > 0, 'no jobs'));
  await claim('ets: testJobListSuccess', async () =>
    document.validate(ogc.jobList, (await get(`${base}/jobs`)).json, 'jobList'));
  await claim('job-list: every filter selects by what it says', async () => {
    const jobs = async (query) => (await get(`${base}/jobs?limit=1000&${query}`)).json.jobs;
    const every = await jobs('');
    const [newest] = every;
    expect((await jobs('processID=echo')).length === every.length, 'processID=echo');
    same((await jobs('processID=terrain-lod')).length, 0, 'processID=terrain-lod');
    expect((await jobs('type=process')).length === every.length, 'type=process');
    same((await jobs('type=other')).length, 0, 'type=other');
    expect((await jobs('status=dismissed')).every((job) => job.status === 'dismissed'), 'status');
    expect((await jobs(`datetime=${newest.created}`)).some(({ jobID }) => jobID === newest.jobID),
           'datetime, an instant');
    expect((await jobs(`datetime=${newest.created}/..`)).length < every.length, 'datetime from');
    expect((await jobs('datetime=../2020-01-01T00:00:00Z')).length === 0, 'datetime to');
    same((await jobs('minDuration=1000')).length, 0, 'minDuration');
    expect((await jobs('maxDuration=100')).every((job) => job.started), 'maxDuration');
    const page = (await get(`${base}/jobs?limit=1&processID=echo`)).json;
    const next = page.links.find(({ rel }) => rel === 'next');
    expect(page.jobs.length === 1 && (await get(next.href)).json.jobs.length === 1, 'the next page');
  });
  await claim('dismiss: a running job ends dismissed, then is gone', async () => {
    const location = created(await async({ inputs: { pause: 30 } }));
    const answer = await ask('DELETE', location);
    document.hold(answer);
    same([answer.status, answer.json.status], [200, 'dismissed'], 'the answer');
    document.validate(ogc.statusInfo, answer.json, 'statusInfo');
    same((await get(`${location}/results`)).json.type, `${kExceptions}result-not-available`, 'type');
    await ask('DELETE', location);
    same((await get(location)).status, 404, 'the status');
  });
  skipped('ets: testgeotiff from raw.githubusercontent.com', 'the service fetches nothing');
};
