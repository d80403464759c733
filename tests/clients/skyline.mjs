// The DEM's own skyline as a camera sees it, and drawn ones against it.
import { eachEdge } from './posts.mjs';

// Samples of the DEM's skyline a column of a picture.
const kSamples = 4;

// For each of the samples, kSamples a column and between these alike: in `rows` the row, in pixels
// from the picture's upper side, of the highest terrain there, NaN where there is none; in
// `pixels_m` how large a pixel is there. All edges of the DEM are projected: straight up from any
// place, the upper side of a triangle is one of its edges.
//
// matrix: from the globe to the screen's -1 to 1, 4 x 4, column by column.
export const demSkyline = (posts, matrix, width, height) => {
  const samples = kSamples * width;
  const count = posts.heights.length;
  const xs = new Float64Array(count);
  const ys = new Float64Array(count);
  const ws = new Float64Array(count);
  const m = matrix;
  // Of a picture of the plane that is a metre away.
  const pixel = 2 / height / Math.hypot(m[1], m[5], m[9]);
  for (let i = 0; i < count; ++i) {
    if (Number.isNaN(posts.heights[i])) continue;
    const [x, y, z] = posts.ecef.subarray(3 * i, 3 * i + 3);
    const w = m[3] * x + m[7] * y + m[11] * z + m[15];
    if (!(w > 0)) throw new Error('the camera stands over the terrain');
    ws[i] = w;
    xs[i] = ((m[0] * x + m[4] * y + m[8] * z + m[12]) / w + 1) / 2 * samples;
    ys[i] = (1 - (m[1] * x + m[5] * y + m[9] * z + m[13]) / w) / 2 * height;
  }
  const rows = new Float64Array(samples).fill(Infinity);
  const pixels_m = new Float64Array(samples).fill(Infinity);
  eachEdge(posts, (i, j) => {
    const [a, b] = xs[i] < xs[j] ? [i, j] : [j, i];
    const first = Math.max(0, Math.ceil(xs[a] - 0.5));
    const last = Math.min(samples - 1, Math.floor(xs[b] - 0.5));
    const slope = (ys[b] - ys[a]) / (xs[b] - xs[a]);
    for (let x = first; x <= last; ++x) {
      const y = Number.isFinite(slope) ? ys[a] + (x + 0.5 - xs[a]) * slope : Math.min(ys[a], ys[b]);
      if (!(y < rows[x])) continue;
      rows[x] = y;
      pixels_m[x] = pixel * Math.min(ws[a], ws[b]);
    }
  });
  // What is above the picture begins at its upper side, what is below is not seen.
  return { rows: rows.map((y) => (y >= height ? NaN : Math.max(0, y))), pixels_m };
};

// By how many pixels a row is beyond those of a skyline from one column or sample to another, all
// of them within a pixel beside it: steep ground is as far away as it is to its side, not as it is
// straight up.
const away = (row, skyline, from, to) => {
  const near = skyline.slice(Math.max(0, from), to + 1);
  const there = near.filter((y) => !Number.isNaN(y));
  if (Number.isNaN(row)) return there.length < near.length ? 0 : Infinity;
  if (there.length === 0) return Infinity;
  // Where the terrain ends its outline goes on down.
  const below = there.length < near.length ? Infinity : Math.max(...there);
  return Math.max(0, Math.min(...there) - row, row - below);
};

// A drawn skyline, a row a column, against the DEM's samples, both ways. error_m: what the finest
// level is off by at most. Result: `most`, pixels; `columns`, how many have terrain; `beyond`, how
// many of them are more than a pixel apart, and more than that error, where a pixel is smaller;
// `straight`, the root mean square straight up.
export const compareSkylines = (drawn, { rows: dem, pixels_m }, error_m) => {
  const result = { most: 0, columns: 0, beyond: 0, straight: 0 };
  let [squares, both] = [0, 0];
  drawn.forEach((row, x) => {
    const first = x * kSamples;
    const samples = [...dem.subarray(first, first + kSamples)];
    // A pixel beside the column's middle, or the sample, and half a sample more.
    const off = Math.max(away(row, dem, first - kSamples / 2, first + kSamples * 3 / 2 - 1),
      ...samples.map((one) => away(one, drawn, x - 1, x + 1)));
    if (samples.some((y) => !Number.isNaN(y))) result.columns += 1;
    result.most = Math.max(result.most, off);
    const nearest_m = Math.min(...pixels_m.subarray(first, first + kSamples));
    if (off > Math.max(1, error_m / nearest_m)) result.beyond += 1;
    const middle = (samples[kSamples / 2 - 1] + samples[kSamples / 2]) / 2;
    if (Number.isNaN(row - middle)) return;
    both += 1;
    squares += (row - middle) ** 2;
  });
  result.straight = both ? Math.sqrt(squares / both) : 0;
  return result;
};
