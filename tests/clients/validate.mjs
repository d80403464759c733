// What can be said of files without a client: the Khronos validator of every GLB, and of every
// tileset what 3D Tiles 1.1 asks of its JSON.
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';

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

const isNumber = (value) => typeof value === 'number' && Number.isFinite(value);
const kVolumes = { region: 6, box: 12, sphere: 4 };

const tileFaults = (tile, above, dir, at) => {
  const faults = [];
  const need = (holds, text) => { if (!holds) faults.push(`${at}: ${text}`); };
  const volume = Object.keys(tile.boundingVolume ?? {}).find((name) => name in kVolumes);
  need(volume && tile.boundingVolume[volume].length === kVolumes[volume]
    && tile.boundingVolume[volume].every(isNumber), 'a bounding volume');
  need(isNumber(tile.geometricError) && tile.geometricError >= 0, 'a geometric error');
  need(tile.geometricError <= above, 'an error not above its parent\'s');
  need(tile.refine === undefined || ['ADD', 'REPLACE'].includes(tile.refine), 'ADD or REPLACE');
  need(tile.transform === undefined
    || (tile.transform.length === 16 && tile.transform.every(isNumber)), 'a matrix');
  need(!(tile.content && tile.contents), 'content or contents');
  need(tile.children === undefined || tile.children.length > 0, 'children, where it has the list');
  for (const { uri } of [...(tile.content ? [tile.content] : []), ...(tile.contents ?? [])]) {
    need(typeof uri === 'string' && existsSync(join(dir, uri)), `content that is there: ${uri}`);
  }
  return faults;
};

export const checkTileset = (file) => {
  const tileset = JSON.parse(readFileSync(file, 'utf8'));
  const faults = [];
  if (tileset.asset?.version !== '1.1') faults.push('asset.version is not 1.1');
  if (!isNumber(tileset.geometricError)) faults.push('geometricError is no number');
  if (!tileset.root?.refine) faults.push('the root has no refine');
  let count = 0;
  const open = [{ tile: tileset.root, above: Infinity, at: 'root' }];
  while (open.length) {
    const { tile, above, at } = open.pop();
    count += 1;
    faults.push(...tileFaults(tile, above, dirname(file), at).map((text) => `needs ${text}`));
    (tile.children ?? []).forEach((child, i) => {
      open.push({ tile: child, above: tile.geometricError, at: `${at}.${i}` });
    });
  }
  return { count, faults };
};
