// Quantized-mesh as the ground of CesiumJS's globe: pictures, and heights at places of the DEM.
import { basename, join } from 'node:path';
import { openClient } from './browser.mjs';
import { kLooks, kSky } from './draw.mjs';
import { shareOf } from './picture.mjs';
import { errorAt } from './terrain_files.mjs';
import { readTileset } from './tileset.mjs';

const kPlaces = 300;
// Of floats that CesiumJS keeps heights in, and of sums of them.
const kRounding = 0.01;

// Posts that have all their neighbours, spread over the DEM, as [longitude, latitude, height].
const placesOf = ({ columns, rows, heights, geodetic }) => {
  const inner = [];
  for (let row = 1; row + 1 < rows; ++row) {
    for (let column = 1; column + 1 < columns; ++column) {
      const at = row * columns + column;
      const around = [-columns, 0, columns].flatMap((step) => [step - 1, step, step + 1]);
      if (around.every((step) => !Number.isNaN(heights[at + step]))) inner.push(at);
    }
  }
  // A step that is no divisor of a row's length goes through all columns.
  const step = Math.max(1, Math.floor(inner.length / kPlaces)) | 1;
  return inner.filter((_, i) => i % step === 0)
    .map((at) => [...geodetic.subarray(3 * at, 3 * at + 3)]);
};

const checkLooks = async ({ opened, name, pictures, report }) => {
  for (const [from, look] of Object.entries(kLooks)) {
    const { tiles, zoom } = await opened.ask('look', look);
    const picture = await opened.shoot(join(pictures, `${name}-globe-${from}.png`));
    const { share, colours } = shareOf(picture, kSky);
    const faults = [];
    if (share < look.least || colours < 20) faults.push('the picture is empty');
    // The globe fills the picture from above: what is of the sky's colour is a gap between tiles.
    if (from === 'above' && share < 1) faults.push(`${((1 - share) * 100).toFixed(3)} % are gaps`);
    report(`${name} as terrain in ${opened.name}, from ${from}`, faults,
      `${tiles} tiles down to zoom ${zoom}, ${colours} colours`);
  }
};

// A tile states its error: of its level at any post, and of cutting and rounding. So that is by how
// much a height may be off.
const checkHeights = async ({ opened, name, posts, terrain, maxzoom, report }) => {
  const places = placesOf(posts);
  const sampled = await opened.ask('sample', places);
  const faults = [];
  let [most, squares, allowed] = [0, 0, 0];
  places.forEach(([longitude, latitude, height], i) => {
    const error = errorAt(terrain.tiles, maxzoom, [longitude, latitude]);
    const off = sampled[i] === null ? Infinity : Math.abs(sampled[i] - height);
    if (!(off <= error + kRounding)) {
      faults.push(`${longitude}, ${latitude}: ${sampled[i]} m, the DEM has ${height}, the tile ` +
        `is off by ${error} at most`);
    }
    most = Math.max(most, off);
    allowed = Math.max(allowed, error);
    squares += off * off;
  });
  report(`${name} as terrain in ${opened.name}, sampleTerrainMostDetailed`, faults,
    `${places.length} posts, off by ${most.toFixed(3)} m at most, ${allowed.toFixed(3)} allowed, ` +
    `root mean square ${Math.sqrt(squares / places.length).toFixed(3)}`);
};

// context: that of draw.mjs, and `terrain` of checkTerrain.
export const checkGlobe = async (context) => {
  const { browser, base, dir, folder, posts, report } = context;
  const { region } = readTileset(dir).root.boundingVolume;
  const opened = await openClient(browser, base, 'globe.html',
    { terrain: `/${folder}/`, region: JSON.stringify(region) });
  const globe = { ...context, opened, name: basename(dir) };
  await checkLooks(globe);
  if (posts) await checkHeights(globe);
  const faults = await opened.allFaults();
  if (!await opened.page.evaluate(() => globalThis.client.hasNormals)) faults.push('no normals');
  report(`${globe.name} as terrain in ${opened.name}, its console and its requests`, faults);
  await opened.close();
};
