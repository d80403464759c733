'use strict';
// The skyline that is seen: of each column of the picture, the first row from above that is not
// sky, in parts of a pixel; and two of them against each other.
(() => {
  // What no lit terrain has, and by how much a pixel differs from it that has some terrain.
  const kSky = [255, 0, 255];
  const kLeast = 24;

  // The rows, NaN where a column has sky alone. draw: puts the picture onto the canvas, at once.
  const read = (canvas, draw) => {
    draw(kSky);
    const copy = new OffscreenCanvas(canvas.width, canvas.height);
    const context = copy.getContext('2d', { willReadFrequently: true });
    context.drawImage(canvas, 0, 0);
    const { data, width, height } = context.getImageData(0, 0, copy.width, copy.height);
    const rows = new Float32Array(width).fill(NaN);
    const distance = (x, y) => {
      const at = 4 * (Math.min(y, height - 1) * width + x);
      return Math.abs(data[at] - kSky[0]) + data[at + 1] + Math.abs(data[at + 2] - kSky[2]);
    };
    for (let x = 0; x < width; ++x) {
      let y = 0;
      while (y < height && distance(x, y) < kLeast) ++y;
      if (y === height) continue;
      // A pixel on the edge is a mixture: its share of sky is found by the one below it.
      const share = Math.min(1, distance(x, y) / Math.max(kLeast, distance(x, y + 1)));
      rows[x] = y + 1 - share;
    }
    return rows;
  };

  // Differences in pixels, level less reference, positive where the level stands higher.
  const compare = (level, reference) => {
    const differences = reference.map((row, x) => row - level[x]);
    let [count, squares, most] = [0, 0, 0];
    for (const difference of differences) {
      if (Number.isNaN(difference)) continue;
      count += 1;
      squares += difference * difference;
      most = Math.max(most, Math.abs(difference));
    }
    return { differences, count, most, rms: count ? Math.sqrt(squares / count) : 0 };
  };

  const drawRows = (context, rows, scale, colour, width) => {
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.beginPath();
    let down = false;
    rows.forEach((row, x) => {
      if (Number.isNaN(row)) { down = false; return; }
      context[down ? 'lineTo' : 'moveTo']((x + 0.5) * scale, (row + 0.5) * scale);
      down = true;
    });
    context.stroke();
  };

  // Both skylines over the picture, the reference's below and wider.
  const drawOver = (canvas, level, reference, colours) => {
    canvas.width = canvas.clientWidth * devicePixelRatio;
    canvas.height = canvas.clientHeight * devicePixelRatio;
    const context = canvas.getContext('2d');
    const scale = canvas.width / reference.length;
    drawRows(context, reference, scale, colours.reference, 3.5 * devicePixelRatio);
    drawRows(context, level, scale, colours.level, 1.3 * devicePixelRatio);
  };

  // The difference over the width; the scale is a power of two of pixels that holds it.
  const drawProfile = (canvas, { differences, most }, colours) => {
    const context = canvas.getContext('2d');
    const { width, height } = canvas;
    const reach = 2 ** Math.max(0, Math.ceil(Math.log2(most || 1)));
    context.clearRect(0, 0, width, height);
    context.fillStyle = colours.quiet;
    context.font = '20px system-ui, sans-serif';
    context.fillText(`+${reach} px`, 6, 22);
    context.fillText(`−${reach} px`, 6, height - 8);
    context.fillRect(0, height / 2, width, 1);
    context.strokeStyle = colours.level;
    context.lineWidth = 2;
    context.beginPath();
    let down = false;
    differences.forEach((difference, i) => {
      if (Number.isNaN(difference)) { down = false; return; }
      const x = (i + 0.5) / differences.length * width;
      const y = height / 2 - difference / reach * (height / 2 - 4);
      context[down ? 'lineTo' : 'moveTo'](x, y);
      down = true;
    });
    context.stroke();
  };

  farhorizon.skyline = { read, compare, drawOver, drawProfile };
})();
