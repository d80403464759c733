// Lines that a client draws over terrain, read from two pictures: with them and without.
import { distanceTo, kLeast } from './picture.mjs';

// What lines are drawn in: no lit terrain has that colour, nor the sky.
export const kLineColour = [0, 255, 0];

// Pixels that the lines have changed towards their colour, as a mask: a line is as wide as a pixel,
// so that most of its pixels are mixtures with what is below it. colour: null where the model has a
// colour for them that is its own.
const lineMask = (without, with_, colour) => {
  const { width, height, data } = without;
  const mask = new Uint8Array(width * height);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const at = 3 * (y * width + x);
      const before = data.subarray(at, at + 3);
      if (distanceTo(with_, x, y, before) < kLeast) continue;
      const nearer = colour &&
        distanceTo(without, x, y, colour) - distanceTo(with_, x, y, colour);
      if (!colour || nearer >= kLeast) mask[y * width + x] = 1;
    }
  }
  return mask;
};

const isNear = (width, height, x, y, reach, holds) => {
  for (let dy = -reach; dy <= reach; ++dy) {
    for (let dx = -reach; dx <= reach; ++dx) {
      const [px, py] = [x + dx, y + dy];
      if (px >= 0 && py >= 0 && px < width && py < height && holds(px, py)) return true;
    }
  }
  return false;
};

// Result: `pixels`: of lines; `stray`: those with no terrain within two pixels; `carried`: the
// share of the drawn skyline's columns that have a line within two pixels of it.
export const measureLines = (without, with_, skyline, sky, colour = kLineColour) => {
  const { width, height } = without;
  const mask = lineMask(without, with_, colour);
  const isLine = (x, y) => mask[y * width + x] === 1;
  const isTerrain = (x, y) => distanceTo(without, x, y, sky) >= kLeast;
  let [pixels, stray, columns, carried] = [0, 0, 0, 0];
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      if (!isLine(x, y)) continue;
      pixels += 1;
      if (!isNear(width, height, x, y, 2, isTerrain)) stray += 1;
    }
  }
  skyline.forEach((row, x) => {
    if (Number.isNaN(row)) return;
    columns += 1;
    if (isNear(width, height, x, Math.floor(row), 2, isLine)) carried += 1;
  });
  return { pixels, stray, carried: columns ? carried / columns : 0 };
};
