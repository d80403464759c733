// Every tile of quantized-mesh, decoded by HERE's decoder: what a tile says of itself, and that
// neighbours meet.
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { gunzipSync } from 'node:zlib';

const kMost = 32767;
const kSides = {
  west: [0, 0], south: [1, 0], east: [0, kMost], north: [1, kMost], // coordinate, its value
};

// A tile as { zoom, x, y, count, places: [u, v, height above the ellipsoid] a vertex, decoded }.
const readTile = (decode, dir, name) => {
  const [, zoom, x, y] = /^terrain-(\d+)-(\d+)-(\d+)\.terrain$/.exec(name).map(Number);
  const bytes = gunzipSync(readFileSync(join(dir, name)));
  const decoded = decode(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
  const { vertexData, header: { minHeight, maxHeight } } = decoded;
  const count = vertexData.length / 3;
  const places = Array.from({ length: count }, (_, i) => [
    vertexData[i], vertexData[count + i],
    minHeight + vertexData[2 * count + i] / kMost * (maxHeight - minHeight)]);
  return { zoom, x, y, count, places, decoded };
};

// How wide a triangle is across its longest side, from above; below zero where it is clockwise.
const widthOf = (a, b, c) => {
  const area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  const longest = Math.max(...[[a, b], [b, c], [c, a]].map(
    ([p, q]) => Math.hypot(p[0] - q[0], p[1] - q[1])));
  return longest ? area / longest : 0;
};
// Each corner is rounded by half a unit both ways, those beside a side of the tile by one: what is
// thinner than that may turn over.
const kTurned = Math.SQRT2;

const tileFaults = ({ zoom, count, places, decoded }, [least, most]) => {
  const { header, triangleIndices: corners, extensions } = decoded;
  const faults = [];
  const need = (holds, text) => { if (!holds) faults.push(text); };
  need(count >= 3 && corners.length >= 3, 'no triangle');
  need(new Set(corners).size === count && Math.max(...corners) === count - 1,
    'a vertex that no triangle has, or a triangle of none');
  need(places.every(([u, v]) => u <= kMost && v <= kMost), 'a vertex beside the tile');
  for (const [side, [axis, value]] of Object.entries(kSides)) {
    const listed = [...decoded[`${side}Indices`]].sort((a, b) => a - b);
    const there = [...places.keys()].filter((i) => places[i][axis] === value);
    need(listed.join() === there.join(), `its ${side} side's list is not that of its vertices`);
  }
  for (let i = 0; i < corners.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => places[corners[i + k]]);
    if (widthOf(a, b, c) < -kTurned) faults.push(`triangle ${i / 3} is clockwise`);
  }
  const { metadata, vertexNormals } = extensions;
  need(metadata?.geometricerror >= 0, 'no geometricerror in its metadata');
  need(vertexNormals?.length === 2 * count, 'no normal for each vertex');
  need(zoom > 0 || Array.isArray(metadata?.available), 'no list of what is available at zoom 0');
  const error = metadata?.geometricerror ?? 0;
  const heights = places.map((place) => place[2]);
  const [low, high] = [Math.min(...heights), Math.max(...heights)];
  need(low >= least - error && high <= most + error,
    `heights ${low} to ${high}, of ground from ${least} to ${most}`);
  need(header.minHeight <= low && header.maxHeight >= high, 'a height beyond those of its header');
  return faults;
};

// The vertices of a side as text that is equal where these are: along it, and their heights to a
// tenth of a millimetre, for each tile counts them from its own least.
const sideOf = ({ places }, side) => {
  const [axis, value] = kSides[side];
  return places.filter((place) => place[axis] === value)
    .map((place) => `${place[1 - axis]}:${place[2].toFixed(4)}`).sort().join(' ');
};

// Whether what layer.json says is available are the tiles that there are.
const availableFaults = (layer, tiles) => {
  const said = new Set();
  layer.available.forEach((rectangles, zoom) => {
    for (const { startX, startY, endX, endY } of rectangles) {
      for (let x = startX; x <= endX; ++x) {
        for (let y = startY; y <= endY; ++y) said.add(`${zoom}-${x}-${y}`);
      }
    }
  });
  return [
    ...[...said].filter((name) => !tiles.has(name)).map((name) => `there is no tile ${name}`),
    ...[...tiles.keys()].filter((name) => !said.has(name))
      .map((name) => `${name} is not available`),
    ...(layer.available.length === layer.maxzoom + 1 ? [] : ['maxzoom is not the last there is']),
  ];
};

// heights: the least and the greatest of the ground, metres above the ellipsoid.
// Result: { tiles, faults, seams }: tiles by "Z-X-Y", seams: sides that two tiles share.
export const checkTerrain = (dir, packages, heights) => {
  const { default: decode } = createRequire(join(packages, 'x.js'))('@here/quantized-mesh-decoder');
  const range = [Math.min(0, heights[0]), Math.max(0, heights[1])];
  const tiles = new Map();
  const faults = [];
  for (const name of readdirSync(dir).filter((one) => one.endsWith('.terrain'))) {
    try {
      const tile = readTile(decode, dir, name);
      tiles.set(`${tile.zoom}-${tile.x}-${tile.y}`, tile);
      faults.push(...tileFaults(tile, range).map((text) => `${name}: ${text}`));
    } catch (failure) {
      faults.push(`${name}: ${failure.message}`);
    }
  }
  let seams = 0;
  for (const [name, tile] of tiles) {
    const { zoom, x, y } = tile;
    for (const [side, other, at] of [
      ['east', 'west', [(x + 1) % 2 ** (zoom + 1), y]], ['north', 'south', [x, y + 1]]]) {
      const neighbour = tiles.get(`${zoom}-${at.join('-')}`);
      if (!neighbour) continue;
      seams += 1;
      if (sideOf(tile, side) !== sideOf(neighbour, other)) {
        faults.push(`${name} and ${zoom}-${at.join('-')} do not meet`);
      }
    }
  }
  faults.push(...availableFaults(JSON.parse(readFileSync(join(dir, 'layer.json'), 'utf8')), tiles));
  return { tiles, faults, seams };
};

export const hasTerrain = (dir) => existsSync(join(dir, 'layer.json'));

// The error that the finest tile at a place states, metres.
export const errorAt = (tiles, zoom, [longitude, latitude]) => {
  const side = 180 / 2 ** zoom;
  const at = [(longitude + 180) / side, (latitude + 90) / side].map(Math.floor);
  return tiles.get(`${zoom}-${at.join('-')}`)?.decoded.extensions.metadata.geometricerror;
};
