// A tileset.json as a tree: any number of children a tile, of contents a tile and of contents a
// level. A level is all contents whose names begin with lodN.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

const kIdentity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

// The product of two 4 x 4 matrices, column by column.
export const multiply = (a, b) => Array.from({ length: 16 }, (_, i) => {
  const [column, row] = [i >> 2, i & 3];
  return [0, 1, 2, 3].reduce((sum, k) => sum + a[4 * k + row] * b[4 * column + k], 0);
});

export const readTileset = (dir) => JSON.parse(readFileSync(join(dir, 'tileset.json'), 'utf8'));

export const contentsOf = (tile) => [
  ...(tile.content ? [tile.content] : []), ...(tile.contents ?? [])];

// All tiles, parents first, as { tile, parent, matrix, at }: matrix leads from the tile to the
// globe, `at` names the tile for people.
export const tilesOf = ({ root }) => {
  const tiles = [{ tile: root, parent: null, matrix: root.transform ?? kIdentity, at: 'root' }];
  for (let i = 0; i < tiles.length; ++i) {
    const { tile, matrix, at } = tiles[i];
    (tile.children ?? []).forEach((child, k) => tiles.push({
      tile: child, parent: tile, at: `${at}.${k}`,
      matrix: child.transform ? multiply(matrix, child.transform) : matrix,
    }));
  }
  return tiles;
};

export const levelOfUri = (uri) => {
  const found = /^lod(\d+)(-\d+-\d+)?\.glb$/.exec(uri);
  return found ? Number(found[1]) : null;
};

// Contents by level, the finest first, as { uri, matrix }.
export const levelsOf = (tileset) => {
  const levels = new Map();
  for (const { tile, matrix } of tilesOf(tileset)) {
    for (const { uri } of contentsOf(tile)) {
      const level = levelOfUri(uri);
      levels.set(level, [...(levels.get(level) ?? []), { uri, matrix }]);
    }
  }
  return new Map([...levels].sort(([a], [b]) => a - b));
};
