// What the schemas of OGC API - Processes 1.0 (openapi/schemas of the standard) require, in JSON Schema.
const text = { type: 'string' };
const link = {
  type: 'object',
  required: ['href'],
  properties: { href: text, rel: text, type: text, hreflang: text, title: text },
};
const links = { type: 'array', items: link };
const time = { type: 'string', format: 'date-time' };
const described = {
  type: 'object',
  properties: { title: text, description: text, keywords: { type: 'array', items: text } },
};
const transmission = { enum: ['value', 'reference'] };

export const exception = {
  type: 'object',
  required: ['type'],
  properties: { type: text, title: text, status: { type: 'integer' }, detail: text, instance: text },
};
export const landingPage = {
  type: 'object', required: ['links'], properties: { title: text, description: text, links },
};
export const confClasses = {
  type: 'object',
  required: ['conformsTo'],
  properties: { conformsTo: { type: 'array', items: text } },
};
export const statusInfo = {
  type: 'object',
  required: ['jobID', 'status', 'type'],
  properties: {
    processID: text,
    type: { enum: ['process'] },
    jobID: text,
    status: { enum: ['accepted', 'running', 'successful', 'failed', 'dismissed'] },
    message: text,
    created: time,
    started: time,
    finished: time,
    updated: time,
    progress: { type: 'integer', minimum: 0, maximum: 100 },
    links,
  },
};
export const jobList = {
  type: 'object',
  required: ['jobs', 'links'],
  properties: { jobs: { type: 'array', items: statusInfo }, links },
};
const summary = {
  type: 'object',
  required: ['id', 'version'],
  properties: {
    ...described.properties,
    id: text,
    version: text,
    jobControlOptions: {
      type: 'array', items: { enum: ['sync-execute', 'async-execute', 'dismiss'] },
    },
    outputTransmission: { type: 'array', items: transmission },
    links,
  },
};
export const processList = {
  type: 'object',
  required: ['processes', 'links'],
  properties: { processes: { type: 'array', items: summary }, links },
};

// schema.yaml of the standard: the dialect of OpenAPI 3.0, and nothing beside it.
const inner = { $ref: '#/$defs/schema' };
const count = { type: 'integer', minimum: 0 };
const flag = { type: 'boolean' };
const schema = {
  oneOf: [
    { type: 'object', required: ['$ref'], properties: { $ref: text } },
    {
      type: 'object',
      not: { required: ['$ref'] },
      additionalProperties: false,
      properties: {
        title: text, multipleOf: { type: 'number', exclusiveMinimum: 0 },
        maximum: { type: 'number' }, exclusiveMaximum: flag,
        minimum: { type: 'number' }, exclusiveMinimum: flag,
        maxLength: count, minLength: count, pattern: text,
        maxItems: count, minItems: count, uniqueItems: flag,
        maxProperties: count, minProperties: count,
        required: { type: 'array', items: text, minItems: 1 },
        enum: { type: 'array', minItems: 1 },
        type: { enum: ['array', 'boolean', 'integer', 'number', 'object', 'string'] },
        not: inner,
        allOf: { type: 'array', items: inner },
        oneOf: { type: 'array', items: inner },
        anyOf: { type: 'array', items: inner },
        items: inner,
        properties: { type: 'object', additionalProperties: inner },
        additionalProperties: { anyOf: [flag, inner] },
        description: text, format: text, default: {}, nullable: flag, readOnly: flag,
        writeOnly: flag, example: {}, deprecated: flag,
        contentMediaType: text, contentEncoding: text, contentSchema: text,
      },
    },
  ],
};
export const process = {
  $defs: { schema },
  type: 'object',
  required: ['id', 'version'],
  properties: {
    ...summary.properties,
    inputs: {
      type: 'object',
      additionalProperties: {
        type: 'object',
        required: ['schema'],
        properties: {
          ...described.properties,
          minOccurs: { type: 'integer' },
          maxOccurs: { anyOf: [{ type: 'integer' }, { enum: ['unbounded'] }] },
          schema: inner,
        },
      },
    },
    outputs: {
      type: 'object',
      additionalProperties: {
        type: 'object',
        required: ['schema'],
        properties: { ...described.properties, schema: inner },
      },
    },
  },
};
// results.yaml: by name, a value that is no object, an object with a value, a bounding box, or a link.
export const results = {
  type: 'object',
  additionalProperties: {
    anyOf: [
      { type: ['string', 'number', 'boolean', 'array'] },
      { type: 'object', required: ['value'] },
      { type: 'object', required: ['bbox'] },
      link,
    ],
  },
};
