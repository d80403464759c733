// Tilesets in CesiumJS and in three.js: that there is a picture, that its skyline is the DEM's, and
// that horizon edges are drawn where the skyline is.
import { existsSync, readFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { openClient } from './browser.mjs';
import { kLineColour, measureLines } from './lines.mjs';
import { shareOf, skylineOf } from './picture.mjs';
import { compareSkylines, demSkyline } from './skyline.mjs';
import { levelsOf, readTileset, tilesOf } from './tileset.mjs';

// What clients draw the sky in: no terrain has that colour.
export const kSky = [255, 0, 255];
// From above, where much of the picture is terrain, and from outside, nearly level.
export const kLooks = {
  above: { heading: 0, pitch: -50, range: 1.6, least: 0.2 },
  outside: { heading: 120, pitch: -2, range: 1.4, least: 0.005 },
};
// Where skylines are looked at from: around the tile and level, from close beside it, down onto its
// slopes, and from far away, all of it and a part through a long lens, where a pixel is a ninth as
// large. `error` makes the client refine as far as there are levels.
const kSkylines = [
  ...[0, 60, 120, 180, 240, 300].map((heading) => (
    { name: `level, ${heading}`, heading, pitch: 0, range: 1.6, fov: 75 })),
  ...[20, 200].map((heading) => (
    { name: `beside, ${heading}`, heading, pitch: -2, range: 1.15, fov: 80 })),
  { name: 'down, 250', heading: 250, pitch: -20, range: 1.6, fov: 75 },
  ...[30, 270].map((heading) => (
    { name: `far, ${heading}`, heading, pitch: -0.5, range: 8, fov: 14.5 })),
  ...[75, 165, 330].map((heading) => (
    { name: `lens, ${heading}`, heading, pitch: -0.2, range: 8, fov: 1.6 })),
].map((view) => ({ ...view, error: 0.05 }));

const checkLooks = async ({ opened, name, client, pictures, report }) => {
  for (const [from, look] of Object.entries(kLooks)) {
    const began = Date.now();
    const { tiles, triangles } = await opened.ask('look', look);
    const took = Date.now() - began;
    const picture = await opened.shoot(join(pictures, `${name}-${client}-${from}.png`));
    const { share, colours } = shareOf(picture, kSky);
    const faults = share < look.least || colours < 20 ? ['the picture is empty'] : [];
    report(`${name} in ${opened.name}, from ${from}`, faults,
      `${tiles} tiles, ${triangles} triangles, ${(100 * share).toFixed(1)} % of the picture, ` +
      `settled after ${took} ms`);
  }
};

// Between the DEM's greatest height and its least.
const middleHeight = ({ geodetic }) => {
  let [least, greatest] = [Infinity, -Infinity];
  for (let i = 2; i < geodetic.length; i += 3) {
    if (Number.isNaN(geodetic[i])) continue;
    least = Math.min(least, geodetic[i]);
    greatest = Math.max(greatest, geodetic[i]);
  }
  return (least + greatest) / 2;
};

const checkSkylines = async ({ opened, name, dir, posts, client, pictures, report }, views) => {
  const faults = [];
  const { levels: [finest] } = JSON.parse(readFileSync(join(dir, 'report.json'), 'utf8'));
  let [most, columns, straight] = [0, 0, 0];
  const height = middleHeight(posts);
  for (const view of views) {
    const { matrix } = await opened.ask('look', { ...view, height });
    const picture = await opened.shoot();
    const found = compareSkylines(skylineOf(picture, kSky),
      demSkyline(posts, matrix, picture.width, picture.height), finest.geometric_error_m);
    most = Math.max(most, found.most);
    straight = Math.max(straight, found.straight);
    columns += found.columns;
    if (found.columns < 100) faults.push(`${view.name}: ${found.columns} columns have terrain`);
    if (found.beyond === 0) continue;
    faults.push(`${view.name}: ${found.beyond} of ${found.columns} columns are off by up to ` +
      `${found.most.toFixed(1)} pixels`);
    await opened.shoot(
      join(pictures, `${name}-${client}-skyline-${view.name.replace(', ', '-')}.png`));
  }
  report(`${name} in ${opened.name}, skylines against the DEM's`, faults,
    `${views.length} views, ${columns} columns, at most ${most.toFixed(2)} pixels, root mean ` +
    `square of the worst view ${straight.toFixed(2)} straight up`);
};

// The edges of each level over that level, from so far that lines of sight are nearly parallel, and
// level, as horizons are defined.
const kEdgeLook = { heading: 75, pitch: 0, range: 40, fov: 2.9, error: 0.05 };
// How much of a level's skyline its own edges have at least, as pixels show it.
const kCarried = 0.99;
// CesiumJS draws the edges of models at the depth where they are, so that some are behind the
// ground that they lie in.
const kCarriedInline = 0.6;
// Horizons are those of straight lines over the DEM's own grid. Of a tile so wide that the Earth
// falls off within it by more pixels than this, other edges are seen.
const kMostFall = 2;
const fallIn = ({ radius }, { width }) => {
  const pixel = 2 * kEdgeLook.range * radius * Math.tan(kEdgeLook.fov * Math.PI / 360) / width;
  return radius ** 2 / (2 * 6_371_000) / pixel;
};
// Two pictures, without lines and with them. what: says which, show: draws them.
const checkLines = async (
  { opened, name, posts, pictures, report }, what, { show, colour, least, file },
) => {
  const height = posts && middleHeight(posts);
  const seen = await opened.ask('look', { ...kEdgeLook, height });
  const without = await opened.shoot();
  await show();
  const drawn = await opened.shoot(join(pictures, `${name}-${file}.png`));
  const { pixels, stray, carried } = measureLines(
    without, drawn, skylineOf(without, kSky), kSky, colour);
  const fall = fallIn(seen, without);
  const share = `on ${(100 * carried).toFixed(1)} % of the skyline's columns`;
  const faults = [];
  if (pixels < 200) faults.push(`${pixels} pixels of lines`);
  if (stray > 0) faults.push(`${stray} pixels of lines are beside the terrain`);
  if (fall < kMostFall && carried < least) faults.push(`lines are ${share}`);
  const excuse = fall < kMostFall ? ''
    : `; not asked for, the Earth falls off by ${fall.toFixed(1)} pixels`;
  report(`${name} in ${opened.name}, ${what}`, faults, `${pixels} pixels, ${share}${excuse}`);
};

// lodN-horizon.glb over its level, or over the tileset as it is streamed. Lines lie in the frame of
// the root, wherever the level's contents do.
const checkHorizon = async (drawn, level) => {
  const { opened, dir, folder, client } = drawn;
  const uri = `lod${level}-horizon.glb`;
  if (!existsSync(join(dir, uri))) return;
  const [{ matrix }] = tilesOf(readTileset(dir));
  await checkLines(drawn, uri, {
    show: () => opened.ask('showLines', { url: `${folder}/${uri}`, matrix }, kLineColour),
    colour: kLineColour, least: kCarried, file: `${client}-lines-${level}`,
  });
  await opened.ask('showLines', null);
};
const checkLevels = async (drawn) => {
  const { opened, dir, folder } = drawn;
  for (const [level, contents] of levelsOf(readTileset(dir))) {
    await opened.ask('showContents',
      contents.map(({ uri, matrix }) => ({ url: `${folder}/${uri}`, matrix })));
    await checkHorizon(drawn, level);
  }
  await opened.ask('showContents', []);
};

// Of a build with --edges inline or both: what EXT_mesh_primitive_edge_visibility draws.
const hasInlineEdges = (dir) => {
  const [{ uri }] = levelsOf(readTileset(dir)).get(0);
  const bytes = readFileSync(join(dir, uri));
  const { extensionsUsed } = JSON.parse(bytes.toString('utf8', 20, 20 + bytes.readUInt32LE(12)));
  return extensionsUsed?.includes('EXT_mesh_primitive_edge_visibility');
};
const checkInlineEdges = (drawn) => checkLines(drawn, 'edges of the models\' own', {
  show: () => drawn.opened.ask('showInlineEdges', true),
  colour: null, least: kCarriedInline, file: 'cesium-inline',
});

const open = async (context, client) => {
  const folder = `/${context.folder}`;
  const opened = await openClient(
    context.browser, context.base, `${client}.html`, { tileset: `${folder}/tileset.json` });
  return { ...context, name: basename(context.dir), client, folder, opened };
};
const finish = async ({ opened, name, report }) => {
  report(`${name} in ${opened.name}, its console and its requests`, await opened.allFaults());
  await opened.close();
};

// context: { browser, base, dir, folder, posts, pictures, report }; folder: the server's name of
// dir; posts: of the DEM, null where it is not known.
export const checkCesium = async (context) => {
  const drawn = await open(context, 'cesium');
  await checkLooks(drawn);
  if (context.posts) await checkSkylines(drawn, kSkylines);
  await checkLevels(drawn);
  if (hasInlineEdges(context.dir)) await checkInlineEdges(drawn);
  await finish(drawn);
};
export const checkThree = async (context) => {
  const drawn = await open(context, 'three');
  await checkLooks(drawn);
  if (context.posts) await checkSkylines(drawn, kSkylines.filter((_, i) => i % 4 === 1));
  await checkHorizon(drawn, 0);
  await finish(drawn);
};
