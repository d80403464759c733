// What can be said of files without a client: the Khronos validator of every GLB, JSON Schemas of
// tileset.json and layer.json, and what 3D Tiles asks of a tree that no schema can say.
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { contentsOf, levelOfUri, levelsOf, readTileset, tilesOf } from './tileset.mjs';

const kSchemas = join(dirname(fileURLToPath(import.meta.url)), 'schemas');

export const validateGlbs = async (dir, packages) => {
  const validator = createRequire(join(packages, 'x.js'))('gltf-validator');
  const faults = [];
  const names = readdirSync(dir, { recursive: true }).filter((name) => name.endsWith('.glb'));
  for (const name of names) {
    const report = await validator.validateBytes(new Uint8Array(readFileSync(join(dir, name))), {
      maxIssues: 100,
      externalResourceFunction: () => Promise.reject(new Error('no file beside it')),
    });
    // The validator does not know these, which it says as a hint; the rest counts from warnings on.
    for (const { severity, code, message, pointer } of report.issues.messages) {
      if (severity <= 1) faults.push(`${name}: ${code} ${pointer ?? ''}: ${message}`);
    }
  }
  return { count: names.length, version: validator.version(), faults };
};

// name: "tileset.json" or "layer.json"; faults by the schema of that name.
export const schemaFaults = (dir, name, packages) => {
  const { default: Ajv } = createRequire(join(packages, 'x.js'))('ajv/dist/2020.js');
  const schema = join(kSchemas, name.replace('.json', '.schema.json'));
  const check = new Ajv({ allErrors: true }).compile(JSON.parse(readFileSync(schema, 'utf8')));
  if (check(JSON.parse(readFileSync(join(dir, name), 'utf8')))) return [];
  return check.errors.map(({ instancePath, message }) => `${name}${instancePath} ${message}`);
};

const isWithin = (inner, outer) => !inner || !outer || (inner[0] >= outer[0] && inner[1] >= outer[1]
  && inner[2] <= outer[2] && inner[3] <= outer[3] && inner[4] >= outer[4] && inner[5] <= outer[5]);
const tileFaults = ({ tile, parent, at }, dir) => {
  const faults = [];
  const need = (holds, text) => { if (!holds) faults.push(`${at} needs ${text}`); };
  const contents = contentsOf(tile);
  const levels = contents.map(({ uri }) => levelOfUri(uri));
  need(contents.every(({ uri }) => existsSync(join(dir, uri))), 'content that is there');
  need(levels.every((level) => level !== null), 'contents that are named lodN or lodN-X-Y');
  if (!parent) return faults;
  need(tile.geometricError <= parent.geometricError, 'an error not above its parent\'s');
  need(isWithin(tile.boundingVolume.region, parent.boundingVolume.region),
    'a region within its parent\'s');
  return faults;
};

// Result: { count: of tiles, levels: how many contents each has, faults }.
export const checkTileset = (dir, packages) => {
  const faults = schemaFaults(dir, 'tileset.json', packages);
  if (faults.length) return { count: 0, levels: [], faults };
  const tileset = readTileset(dir);
  const tiles = tilesOf(tileset);
  faults.push(...tiles.flatMap((one) => tileFaults(one, dir)));
  const levels = levelsOf(tileset);
  if ([...levels.keys()].some((level, i) => level !== i)) faults.push('a level is missing');
  const uris = [...levels.values()].flat().map(({ uri }) => uri);
  if (new Set(uris).size < uris.length) faults.push('a content is there twice');
  const files = readdirSync(dir).filter((name) => levelOfUri(name) !== null);
  faults.push(...files.filter((name) => !uris.includes(name)).map((name) => `no tile has ${name}`));
  return { count: tiles.length, levels: [...levels.values()].map((one) => one.length), faults };
};
