// The files of grid.h, in JavaScript.
import fs from 'node:fs';

/** {columns, rows, heights: Float32Array}; a missing post is NaN. */
export function readGrid(path) {
  const bytes = fs.readFileSync(path);
  const [columns, rows] = new Int32Array(bytes.buffer, bytes.byteOffset, 2);
  const heights = new Float32Array(bytes.buffer, bytes.byteOffset + 8, columns * rows);
  return {columns, rows, heights};
}

/** vertices: column, row, metres of each in turn; triangles: three vertices of each in turn. */
export function writeMesh(path, vertices, triangles) {
  const counts = new Int32Array([vertices.length / 3, triangles.length / 3]);
  const parts = [counts, Float32Array.from(vertices), Int32Array.from(triangles)];
  fs.writeFileSync(path, Buffer.concat(parts.map(part => new Uint8Array(part.buffer))));
}

/** The triangles of all posts: FullMesh of grid.h. */
export function fullTriangles({columns, rows, heights}) {
  const triangles = [];
  const add = (a, b, c) => {
    const sum = heights[a] + heights[b] + heights[c];
    if (!Number.isNaN(sum)) triangles.push(a, b, c);
  };
  for (let row = 0; row + 1 < rows; ++row) {
    for (let column = 0; column + 1 < columns; ++column) {
      const a = row * columns + column, b = a + 1, d = a + columns, c = d + 1;
      if (!Number.isNaN(heights[a] + heights[c])) {
        add(a, b, c);
        add(a, c, d);
      } else {
        add(a, b, d);
        add(b, c, d);
      }
    }
  }
  return Uint32Array.from(triangles);
}
