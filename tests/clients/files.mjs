// What can be said of a build's files without a client, and its DEM's posts as GDAL reads them.
import { readFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { readPosts } from './posts.mjs';
import { checkTerrain, hasTerrain } from './terrain_files.mjs';
import { readTileset } from './tileset.mjs';
import { checkTileset, schemaFaults, validateGlbs } from './validate.mjs';

// The least and the greatest of a list that may have millions of numbers, and holes.
const rangeOf = (values) => values.reduce(([least, most], value) => (
  Number.isNaN(value) ? [least, most] : [Math.min(least, value), Math.max(most, value)]),
[Infinity, -Infinity]);

// The DEM's posts; null where nothing says of what DEM the folder was built.
export const readDem = ({ dir, dem }, report) => {
  if (!dem) {
    report(`${basename(dir)}: no DEM was named`, [], 'its skyline and heights are not looked at');
    return null;
  }
  const said = JSON.parse(readFileSync(join(dir, 'report.json'), 'utf8'));
  const posts = readPosts(dem, said);
  const { columns, rows, heights } = posts;
  const nodata = heights.reduce((count, height) => count + (Number.isNaN(height) ? 1 : 0), 0);
  const range = rangeOf(heights);
  const alike = columns === said.dem.columns && rows === said.dem.rows
    && nodata === said.dem.nodata_posts
    && range.every((height, k) => Math.abs(height - said.dem.heights_m[k]) < 1e-3);
  const found = `${columns} x ${rows} posts, ${nodata} without data, ${range.join(' to ')} m`;
  report(`${basename(dir)}: ${basename(dem)} read by GDAL's programs as by farhorizon`,
    alike ? [] : [`report.json has ${JSON.stringify(said.dem)}`], found);
  return posts;
};

const heightsOf = (dir, posts) => (posts
  ? rangeOf(posts.geodetic.filter((_, i) => i % 3 === 2))
  : readTileset(dir).root.boundingVolume.region.slice(4));

// Result: what checkTerrain found and the last zoom, null where there is no terrain.
export const checkFiles = async ({ dir, posts, packages, report }) => {
  const name = basename(dir);
  const { count, version, faults } = await validateGlbs(dir, packages);
  if (count === 0) faults.push('there is no GLB');
  report(`${name}: glTF validator ${version}`, faults, `${count} files`);
  const tileset = checkTileset(dir, packages);
  report(`${name}: tileset.json by its schema, and its tree`, tileset.faults,
    `${tileset.count} tiles, contents by level ${tileset.levels.join(', ')}`);
  if (!hasTerrain(dir)) return null;
  report(`${name}: layer.json by its schema`, schemaFaults(dir, 'layer.json', packages));
  const terrain = checkTerrain(dir, packages, heightsOf(dir, posts));
  report(`${name}: quantized-mesh-decoder on terrain tiles`, terrain.faults,
    `${terrain.tiles.size} tiles, ${terrain.seams} sides of two`);
  const { maxzoom } = JSON.parse(readFileSync(join(dir, 'layer.json'), 'utf8'));
  return { terrain, maxzoom };
};
