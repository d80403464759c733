// The posts of a DEM on the globe, read by GDAL's programs and by nothing of farhorizon: what
// clients draw is held against them.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const kMostOutput = 1 << 30;
// Fills that no ground on Earth can be, which stand for no data whatever a file says.
const kFills = new Set([-32768, -9999, Math.fround(-3.4028234663852886e38)]);

// The raster's values as doubles, row by row; NaN where there are no data.
const readHeights = (dem, { size: [columns, rows], bands: [{ noDataValue }] }) => {
  const folder = mkdtempSync(join(tmpdir(), 'farhorizon-posts-'));
  try {
    const raw = join(folder, 'heights');
    execFileSync('gdal_translate',
      ['-q', '-of', 'ENVI', '-ot', 'Float64', '-unscale', dem, raw], { stdio: 'pipe' });
    const bytes = readFileSync(raw);
    const heights = new Float64Array(columns * rows);
    for (let i = 0; i < heights.length; ++i) {
      const value = bytes.readDoubleLE(8 * i);
      heights[i] = value === Number(noDataValue) || kFills.has(value) ? NaN : value;
    }
    return heights;
  } finally {
    rmSync(folder, { recursive: true });
  }
};

// The way from a reference system to WGS 84 by the datum operation of that name, as PROJ spells it.
const pipelineOf = (crs, operation) => {
  const listed = execFileSync('projinfo', ['-s', crs, '-t', 'EPSG:4979', '-o', 'PROJ',
    '--spatial-test', 'intersects'], { stdio: 'pipe' }).toString();
  const one = listed.split('Operation No.').find((text) => text.includes(operation));
  const pipeline = /PROJ string:\n((?:.*\S.*\n?)+)/.exec(one ?? '')?.[1];
  if (!pipeline) throw new Error(`projinfo knows no operation "${operation}" of ${crs}`);
  return pipeline.replaceAll(/\s+/g, ' ').trim();
};

// Map coordinates and heights as degrees of longitude and latitude and heights above the ellipsoid.
const toGeodetic = (crs, operation, points) => {
  const input = points.map((point) => point.join(' ')).join('\n');
  const way = operation ? ['-ct', pipelineOf(crs, operation)] : [];
  const output = execFileSync('gdaltransform', ['-s_srs', crs, '-t_srs', 'EPSG:4979', ...way],
    { input: `${input}\n`, maxBuffer: kMostOutput, stdio: 'pipe' });
  return output.toString().trim().split('\n').map((line) => line.trim().split(/\s+/).map(Number));
};

// Earth-fixed metres of a place on WGS 84.
const toEcef = ([longitude, latitude, height]) => {
  const [a, f] = [6378137, 1 / 298.257223563];
  const e2 = f * (2 - f);
  const [lambda, phi] = [longitude, latitude].map((degrees) => degrees * Math.PI / 180);
  const n = a / Math.sqrt(1 - e2 * Math.sin(phi) ** 2);
  return [(n + height) * Math.cos(phi) * Math.cos(lambda),
    (n + height) * Math.cos(phi) * Math.sin(lambda), (n * (1 - e2) + height) * Math.sin(phi)];
};

// report: of the build, which says in what reference system, heights included, the DEM has been
// read, and by which datum operation it was placed.
// Result: { columns, rows, heights, geodetic, ecef }; places have three numbers a post, NaN where
// it has no data.
export const readPosts = (dem, report) => {
  const { crs } = report.dem;
  const [operation] = report.assumptions
    .map(({ text }) => /datum operation "([^"]+)"/.exec(text)?.[1]).filter(Boolean);
  const info = JSON.parse(execFileSync('gdalinfo', ['-json', dem],
    { maxBuffer: kMostOutput, stdio: 'pipe' }));
  const [columns, rows] = info.size;
  const heights = readHeights(dem, info);
  const g = info.geoTransform;
  const kept = [];
  heights.forEach((height, i) => { if (!Number.isNaN(height)) kept.push(i); });
  const places = toGeodetic(crs, operation, kept.map((i) => {
    const [x, y] = [i % columns + 0.5, Math.floor(i / columns) + 0.5];
    return [g[0] + x * g[1] + y * g[2], g[3] + x * g[4] + y * g[5], heights[i]];
  }));
  const geodetic = new Float64Array(3 * heights.length).fill(NaN);
  const ecef = new Float64Array(3 * heights.length).fill(NaN);
  kept.forEach((i, k) => {
    geodetic.set(places[k], 3 * i);
    ecef.set(toEcef(places[k]), 3 * i);
  });
  return { columns, rows, heights, geodetic, ecef };
};

// Calls edge(i, j) for every edge of the DEM's triangles: cells are split from their first corner
// to the one across; of one with three posts there is the triangle of these.
export const eachEdge = ({ columns, rows, heights }, edge) => {
  const has = (i) => !Number.isNaN(heights[i]);
  const line = (i, j) => { if (has(i) && has(j)) edge(i, j); };
  // A side belongs to a triangle where a cell beside it has a third post.
  for (let row = 0; row + 1 < rows; ++row) {
    for (let column = 0; column + 1 < columns; ++column) {
      const a = row * columns + column;
      const [b, c, d] = [a + 1, a + columns, a + columns + 1];
      if ([a, b, c, d].filter(has).length < 3) continue;
      for (const [i, j] of [[a, b], [a, c], [b, d], [c, d]]) line(i, j);
      if (has(a) && has(d)) edge(a, d);
      else line(b, c);
    }
  }
};
