// node npm_meshes.mjs DEM.grid CELL_X CELL_Y TOOL PREFIX TRIANGLES...
//
// TOOL: delatin, martini, meshoptimizer or meshoptimizer-free. Writes PREFIX-TRIANGLES.mesh for
// each size and prints a JSON object for each; cells in metres. The packages are those of
// PEERS_PACKAGES, a folder in which npm has installed package.json. Exit status 3: the tool cannot
// mesh such a DEM; stdout says why.
import {createRequire} from 'node:module';
import path from 'node:path';
import {pathToFileURL} from 'node:url';

import {fullTriangles, readGrid, writeMesh} from './grid.mjs';

const [gridPath, cellX, cellY, tool, prefix, ...sizes] = process.argv.slice(2);
const asked = sizes.map(Number).sort((a, b) => b - a);
const require = createRequire(path.resolve(process.env.PEERS_PACKAGES ?? '.') + '/');
const load = name => import(pathToFileURL(require.resolve(name)));
const grid = readGrid(gridPath);
const {columns, rows, heights} = grid;

function cannot(why) {
  console.log(JSON.stringify({cannot: why}));
  process.exit(3);
}

let begin;
const seconds = () => (performance.now() - begin) / 1000;
function save(size, took, vertices, triangles, more = {}) {
  writeMesh(`${prefix}-${size}.mesh`, vertices, triangles);
  const said = {asked: size, triangles: triangles.length / 3, seconds: took, ...more};
  console.log(JSON.stringify(said));
}

/** Refines from two triangles on: the sizes are stops of one run. */
async function delatin() {
  if (heights.some(Number.isNaN)) cannot('delatin knows no missing posts');
  const Delatin = (await load('delatin')).default;
  begin = performance.now();
  const tin = new Delatin(heights, columns, rows);
  for (const size of [...asked].reverse()) {
    while (tin.triangles.length / 3 < size && tin.getMaxError() > 0) tin.refine();
    const took = seconds(), paused = performance.now();
    const vertices = [];
    for (let i = 0; i < tin.coords.length; i += 2) {
      const [x, y] = [tin.coords[i], tin.coords[i + 1]];
      vertices.push(x, y, tin.heightAt(x, y));
    }
    save(size, took, vertices, tin.triangles);
    begin += performance.now() - paused; // writing is not meshing
  }
}

/** All triangles, and all posts in metres, as meshoptimizer takes them. */
function fullMesh() {
  const positions = new Float32Array(heights.length * 3);
  heights.forEach((z, post) => {
    const x = (post % columns) * cellX, y = Math.floor(post / columns) * cellY;
    positions.set([x, y, z || 0], 3 * post); // a missing post is in no triangle
  });
  return {all: fullTriangles(grid), positions};
}

/** simplify(simplifier, full mesh, size) returns {kept, placeOf}: triangles; where a post now is. */
async function meshoptimizer(simplify) {
  const {MeshoptSimplifier} = await load('meshoptimizer');
  await MeshoptSimplifier.ready;
  for (const size of asked) {
    const full = fullMesh();
    begin = performance.now();
    const {kept, placeOf} = simplify(MeshoptSimplifier, full, size);
    const took = seconds();
    if (kept.length / 3 > 1.02 * size) continue; // no collapse is left that it would do
    const numbers = new Map(), vertices = [];
    const triangles = Array.from(kept, post => {
      if (!numbers.has(post)) {
        numbers.set(post, numbers.size);
        vertices.push(...placeOf(post));
      }
      return numbers.get(post);
    });
    save(size, took, vertices, triangles);
  }
}

/** Its users lock the border of tiles, so that neighbours meet. Vertices are posts. */
function withLockedBorder(simplifier, {all, positions}, size) {
  const [kept] = simplifier.simplify(all, positions, 3, 3 * size, 1, ['LockBorder']);
  return {kept, placeOf: post => [post % columns, Math.floor(post / columns), heights[post]]};
}

/** The best that it can: vertices move to where the error is least, the border with them. */
function withFreeVertices(simplifier, {all, positions}, size) {
  const none = new Float32Array(0);
  const [count] = simplifier.simplifyWithUpdate(all, positions, 3, none, 0, [], null, 3 * size, 1);
  const placeOf = post =>
    [positions[3 * post] / cellX, positions[3 * post + 1] / cellY, positions[3 * post + 2]];
  return {kept: all.subarray(0, count), placeOf};
}

/** It takes an error, not a number of triangles: searches for the least error with so many. */
async function martini() {
  const Martini = (await load('@mapbox/martini')).default;
  if (columns !== rows || ((columns - 1) & (columns - 2)) !== 0)
    cannot('martini needs a square of 2^k + 1 posts');
  if (heights.some(Number.isNaN)) cannot('martini knows no missing posts');
  begin = performance.now();
  const tile = new Martini(columns).createTile(heights);
  const prepared = seconds();
  for (const size of asked) {
    let low = 0, high = 1e5, best; // metres: more than any ground has
    for (let step = 0; step < 50; ++step) {
      const error = (low + high) / 2;
      begin = performance.now();
      const mesh = tile.getMesh(error);
      const took = prepared + seconds();
      if (mesh.triangles.length / 3 > size) {
        low = error;
      } else {
        high = error;
        best = {mesh, took};
      }
    }
    if (!best) continue;
    const vertices = [];
    for (let i = 0; i < best.mesh.vertices.length; i += 2) {
      const [x, y] = [best.mesh.vertices[i], best.mesh.vertices[i + 1]];
      vertices.push(x, y, heights[y * columns + x]);
    }
    save(size, best.took, vertices, best.mesh.triangles);
  }
}

const tools = {
  delatin,
  martini,
  'meshoptimizer': () => meshoptimizer(withLockedBorder),
  'meshoptimizer-free': () => meshoptimizer(withFreeVertices),
};
await tools[tool]();
