// What a process description says of each input of terrain-lod is tried: what is within is taken, what
// is outside is refused. The DEM is no raster, so that a request without another fault is 415.
import { postJson } from './service.mjs';
import { claim, expect, same } from './verdict.mjs';

const kNoRaster = Buffer.from('no raster').toString('base64');

// Values within a schema and just outside it. A schema that says nothing gives none.
const probesOf = (schema) => {
  if (schema.oneOf) {
    const all = schema.oneOf.map(probesOf);
    // Outside one kind may be within another: texts beside numbers.
    return { within: all.flatMap(({ within }) => within), outside: all.flatMap((one) => one.outside) };
  }
  const within = schema.default === undefined ? [] : [schema.default];
  const outside = [];
  if (schema.enum) {
    within.push(...schema.enum);
    outside.push('none of these');
  }
  if (schema.type === 'integer') outside.push(1.5);
  if (schema.minimum !== undefined) {
    (schema.exclusiveMinimum ? outside : within).push(schema.minimum);
    outside.push(schema.minimum - 1);
  }
  if (schema.maximum !== undefined) {
    within.push(schema.maximum);
    outside.push(schema.maximum + 1);
  }
  if (schema.type === 'array' && schema.items) {
    const items = probesOf(schema.items);
    if (items.within.length) within.push(items.within.slice(0, schema.maxItems));
    outside.push(...items.outside.map((item) => [item]));
    if (schema.maxItems) outside.push(Array.from({ length: schema.maxItems + 1 }, (_, i) => i + 2));
    if (schema.uniqueItems) outside.push([5, 5]);
  }
  return { within, outside };
};

export const checkInputs = async (run) => {
  const description = (await (await fetch(`${run.base}/processes/terrain-lod`)).json());
  const send = async (inputs) => {
    const answer = await postJson(`${run.base}/processes/terrain-lod/execution`, { inputs });
    run.document.hold(answer);
    return answer;
  };
  for (const [name, { schema }] of Object.entries(description.inputs)) {
    if (name === 'dem') continue;
    await claim(`inputs: ${name} is what its schema says`, async () => {
      const { within, outside } = probesOf(schema);
      for (const value of within) {
        const answer = await send({ dem: kNoRaster, [name]: value });
        same([answer.status, answer.json.code], [415, 'not-a-raster'],
             `the answer to ${JSON.stringify(value)} (${answer.json.detail})`);
        const qualified = await send({ dem: kNoRaster, [name]: { value } });
        if (!Array.isArray(value)) same(qualified.status, 415, 'the answer to a qualified value');
      }
      for (const value of outside) {
        const answer = await send({ dem: kNoRaster, [name]: value });
        same([answer.status, answer.json.code], [400, 'invalid-parameter'],
             `the answer to ${JSON.stringify(value)}`);
        expect(answer.json.detail.includes(name), `the detail does not name it: ${answer.json.detail}`);
      }
      return `${within.length} within, ${outside.length} outside`;
    });
  }
  await claim('inputs: one that there is not is refused', async () => {
    const answer = await send({ dem: kNoRaster, levls: 2 });
    same([answer.status, answer.json.code], [400, 'unknown-parameter'], 'the answer');
  });
};
