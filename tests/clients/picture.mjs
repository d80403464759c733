// Pictures of a browser, and what is read from them.
import { inflateSync } from 'node:zlib';

const kSignature = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
const kChannels = { 2: 3, 6: 4 };

const paeth = (a, b, c) => {
  const [pa, pb, pc] = [Math.abs(b - c), Math.abs(a - c), Math.abs(a + b - 2 * c)];
  return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
};
const unfilter = (raw, width, height, channels) => {
  const stride = width * channels;
  const data = new Uint8Array(height * stride);
  const predict = [
    () => 0, (a) => a, (_, b) => b, (a, b) => (a + b) >> 1, paeth];
  for (let y = 0; y < height; ++y) {
    const from = y * (stride + 1) + 1;
    const guess = predict[raw[from - 1]];
    for (let i = 0, at = y * stride; i < stride; ++i, ++at) {
      const left = i >= channels;
      data[at] = raw[from + i] + guess(left ? data[at - channels] : 0, y ? data[at - stride] : 0,
        left && y ? data[at - stride - channels] : 0);
    }
  }
  return data;
};

// A PNG as browsers make it, eight bits a channel, as { width, height, data }: three bytes a pixel.
export const readPng = (png) => {
  if (!png.subarray(0, 8).equals(kSignature)) throw new Error('no PNG');
  const [width, height] = [png.readUInt32BE(16), png.readUInt32BE(20)];
  const channels = kChannels[png[25]];
  if (png[24] !== 8 || !channels || png[28] !== 0) throw new Error('no PNG of a browser');
  const parts = [];
  for (let at = 8; at < png.length; at += 12 + png.readUInt32BE(at)) {
    if (png.toString('latin1', at + 4, at + 8) !== 'IDAT') continue;
    parts.push(png.subarray(at + 8, at + 8 + png.readUInt32BE(at)));
  }
  const all = unfilter(inflateSync(Buffer.concat(parts)), width, height, channels);
  if (channels === 3) return { width, height, data: all };
  const data = new Uint8Array(3 * width * height);
  for (let i = 0; i < width * height; ++i) data.set(all.subarray(4 * i, 4 * i + 3), 3 * i);
  return { width, height, data };
};

// How far the colour of a pixel is from another, summed over its channels.
export const distanceTo = ({ width, data }, x, y, [red, green, blue]) => {
  const at = 3 * (y * width + x);
  return Math.abs(data[at] - red) + Math.abs(data[at + 1] - green) + Math.abs(data[at + 2] - blue);
};

// By how much a pixel with some terrain differs from one with sky alone.
export const kLeast = 24;

// The share of pixels that are not of the colour `sky`, and how many colours these have.
export const shareOf = (picture, sky) => {
  const { width, height, data } = picture;
  const colours = new Set();
  let count = 0;
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      if (distanceTo(picture, x, y, sky) < kLeast) continue;
      const at = 3 * (y * width + x);
      count += 1;
      colours.add((data[at] << 16) | (data[at + 1] << 8) | data[at + 2]);
    }
  }
  return { share: count / (width * height), colours: colours.size };
};

// The drawn skyline: for each column where terrain begins below the sky, in parts of a pixel from
// the picture's upper side; NaN where a column has sky alone.
export const skylineOf = (picture, sky) => {
  const { width, height } = picture;
  const last = height - 1;
  return Float64Array.from({ length: width }, (_, x) => {
    let y = 0;
    while (y < height && distanceTo(picture, x, y, sky) < kLeast) ++y;
    if (y === height) return NaN;
    // A pixel on the edge is a mixture: its share of sky is found by the one below it.
    const below = Math.max(kLeast, distanceTo(picture, x, Math.min(y + 1, last), sky));
    return y + 1 - Math.min(1, distanceTo(picture, x, y, sky) / below);
  });
};
