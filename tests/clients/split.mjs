// A tileset whose level 0 is in parts, made by hand: of a cut of a DEM and of its halves, built in
// one frame. So clients and the viewer are tried on levels of several contents, whatever DEM.
import { execFileSync } from 'node:child_process';
import {
  copyFileSync, cpSync, mkdirSync, readFileSync, rmSync, statSync, writeFileSync,
} from 'node:fs';
import { join } from 'node:path';
import { readTileset } from './tileset.mjs';

const kSide = 129;
const kHalf = 65;
// Near the DEM, for axes that all parts have in common.
const kFrame = '-84.2,36.6';

// What leads from the axes of one matrix to those of another, whose axes are parallel.
const shiftBetween = (from, to) => {
  const away = [12, 13, 14].map((i) => from[i] - to[i]);
  const along = [0, 4, 8].map((axis) => away.reduce((sum, d, k) => sum + d * to[axis + k], 0));
  return [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, ...along, 1];
};

// A region of which nothing is beside the other.
const within = (region, other) => region.map((value, k) => (
  [0, 1, 4].includes(k) ? Math.max(value, other[k]) : Math.min(value, other[k])));

const build = (farhorizon, dem, window, dir, options) => {
  mkdirSync(dir, { recursive: true });
  const cut = join(dir, 'cut.tif');
  execFileSync('gdal_translate',
    ['-q', '-srcwin', ...window.map(String), dem, cut], { stdio: 'pipe' });
  execFileSync(farhorizon,
    ['build', cut, '-o', join(dir, 'out'), '--formats', '3dtiles', ...options], { stdio: 'pipe' });
  return join(dir, 'out');
};

// Writes such a tileset, with its report and the lines of its levels. dem: that of tests/data.
export const makeSplit = ({ farhorizon, dem, folder }) => {
  rmSync(folder, { recursive: true, force: true });
  const work = join(folder, 'work');
  const made = (name, window, levels) => build(farhorizon, dem, window, join(work, name),
    ['--frame', kFrame, '--levels', String(levels)]);
  const dir = join(folder, 'split');
  cpSync(made('whole', [0, 0, kSide, kSide], 2), dir, { recursive: true });
  const tileset = readTileset(dir);
  const { root } = tileset;
  const [fine] = root.children;
  root.children = [0, kHalf - 1].map((column, x) => {
    const half = made(`half${x}`, [column, 0, kHalf, kSide], 1);
    const { root: tile } = readTileset(half);
    const uri = `lod0-${x}-0.glb`;
    copyFileSync(join(half, 'lod0.glb'), join(dir, uri));
    return {
      ...fine, content: { uri }, transform: shiftBetween(tile.transform, root.transform),
      boundingVolume: { region: within(tile.boundingVolume.region, fine.boundingVolume.region) },
    };
  });
  rmSync(join(dir, 'lod0.glb'));
  rmSync(work, { recursive: true });
  writeFileSync(join(dir, 'tileset.json'), JSON.stringify(tileset));
  const list = join(dir, 'manifest.json');
  const { artifacts } = JSON.parse(readFileSync(list, 'utf8'));
  const parts = root.children.map(({ content: { uri } }) => (
    { name: uri, media_type: 'model/gltf-binary', bytes: statSync(join(dir, uri)).size }));
  writeFileSync(list, JSON.stringify(
    { artifacts: [...artifacts.filter(({ name }) => name !== 'lod0.glb'), ...parts] }));
  return dir;
};
