// The front as a picture: vertical against silhouette rms, both by logarithm; a line a tool, a
// point a size. Nearer the lower left is better. One panel a DEM. The card has a background of its
// own, so that it reads alike on a light and on a dark page.
import {against, count, gainText, percent, shareOf} from './tables.mjs';
import {tools} from './tools.mjs';

const ink = '#1f2733', quiet = '#5d6878', faint = '#e4e3dc', paper = '#fbfaf6';
const font = 'font-family="Inter, Segoe UI, Helvetica, Arial, sans-serif"';
// Colours after Okabe and Ito, which the colour-blind tell apart; the marks differ, too.
const looks = {
  'farhorizon': {colour: '#0b62b0', mark: 'circle'},
  'lt': {colour: '#a5488c', mark: 'diamond'},
  'gh': {colour: '#d3588a', mark: 'square'},
  'delatin': {colour: '#c96a12', mark: 'triangle'},
  'meshoptimizer': {colour: '#1b8a68', mark: 'wedge'},
  'meshoptimizer-free': {colour: '#52ab8d', mark: 'cross'},
  'martini': {colour: '#8a9099', mark: 'plus'},
};

const round = value => Number(value.toFixed(2));
function text(x, y, words, look = {}) {
  const {size = 12, fill = ink, anchor = 'start', weight = 400, more = ''} = look;
  return `<text x="${round(x)}" y="${round(y)}" font-size="${size}" fill="${fill}" ` +
         `text-anchor="${anchor}" font-weight="${weight}" ${more}>` +
         `${words.replace(/&/g, '&amp;').replace(/</g, '&lt;')}</text>`;
}

function mark(kind, x, y, r, colour) {
  const path = (...corners) => {
    const places = corners.map(([dx, dy]) => `${round(x + dx * r)},${round(y + dy * r)}`);
    return `<path d="M${places.join('L')}Z" fill="${colour}" stroke="${paper}"/>`;
  };
  switch (kind) {
    case 'circle':
      return `<circle cx="${round(x)}" cy="${round(y)}" r="${r}" fill="${colour}" ` +
             `stroke="${paper}" stroke-width="1.2"/>`;
    case 'square': return path([-.9, -.9], [.9, -.9], [.9, .9], [-.9, .9]);
    case 'diamond': return path([0, -1.25], [1.25, 0], [0, 1.25], [-1.25, 0]);
    case 'triangle': return path([0, -1.25], [1.15, .85], [-1.15, .85]);
    case 'wedge': return path([0, 1.25], [1.15, -.85], [-1.15, -.85]);
    case 'plus':
      return `<path d="M${round(x - 1.2 * r)},${round(y)}h${2.4 * r}m${-1.2 * r},${-1.2 * r}` +
             `v${2.4 * r}" stroke="${colour}" stroke-width="1.8" fill="none"/>`;
    default:
      return `<path d="M${round(x - r)},${round(y - r)}l${2 * r},${2 * r}m0,${-2 * r}l${-2 * r},` +
             `${2 * r}" stroke="${colour}" stroke-width="1.8" fill="none"/>`;
  }
}

/** A logarithmic scale from values to pixels, widened by a little on either side. */
function scale(values, from, to, room) {
  const low = Math.log(Math.min(...values) / room), high = Math.log(Math.max(...values) * room);
  const at = value => from + (to - from) * (Math.log(value) - low) / (high - low);
  const ticks = [];
  for (let decade = -6; decade <= 6; ++decade) {
    for (const step of [1, 2, 5]) {
      const value = Number(`${step}e${decade}`);
      if (Math.log(value) >= low && Math.log(value) <= high) ticks.push(value);
    }
  }
  return {at, ticks: ticks.length > 11 ? ticks.filter(t => /^[1]/.test(t.toExponential())) : ticks};
}

function panel(contest, {x, y, width, height}) {
  const drawn = contest.entries.filter(e => e.vertical_rms_m > 0 && e.silhouette_rms_m > 0);
  const title = text(x, y + 16, contest.name, {size: 14, weight: 600});
  const size = text(x + width, y + 16, `${count(contest.about.triangles)} triangles`,
                    {size: 12, fill: quiet, anchor: 'end'});
  if (!drawn.length) return title + size;
  const box = {left: x + 46, right: x + width, top: y + 30, bottom: y + height - 40};
  const across = scale(drawn.map(e => e.vertical_rms_m), box.left, box.right, 1.25);
  const up = scale(drawn.map(e => e.silhouette_rms_m), box.bottom, box.top, 1.45);
  const parts = [title, size];
  for (const tick of across.ticks) {
    const at = round(across.at(tick));
    parts.push(`<path d="M${at},${box.top}V${box.bottom}" stroke="${faint}"/>`,
               text(at, box.bottom + 16, `${tick}`, {size: 11, fill: quiet, anchor: 'middle'}));
  }
  for (const tick of up.ticks) {
    const at = round(up.at(tick));
    parts.push(`<path d="M${box.left},${at}H${box.right}" stroke="${faint}"/>`,
               text(box.left - 8, at + 4, `${tick}`, {size: 11, fill: quiet, anchor: 'end'}));
  }
  const turned = `translate(${x + 8},${round((box.top + box.bottom) / 2)}) rotate(-90)`;
  parts.push(
    text((box.left + box.right) / 2, box.bottom + 34, 'ground: vertical rms at the posts, metres',
         {size: 11.5, fill: quiet, anchor: 'middle'}),
    text(0, 0, 'skyline: silhouette rms, metres',
         {size: 11.5, fill: quiet, anchor: 'middle', more: `transform="${turned}"`}));

  // How far below the best of the others, from each of our points up to theirs.
  const ours = drawn.filter(e => e.tool === 'farhorizon').sort((a, b) => b.asked - a.asked);
  for (const entry of ours) {
    const gain = against(contest, entry)?.gain;
    if (!(gain > 1.2)) continue;
    const at = round(across.at(entry.vertical_rms_m));
    const from = up.at(entry.silhouette_rms_m) - 7, to = up.at(entry.silhouette_rms_m * gain);
    parts.push(`<path d="M${at},${round(from)}V${round(to)}" stroke="${looks.farhorizon.colour}" ` +
               'stroke-opacity=".4" stroke-dasharray="1.5 3.5" stroke-linecap="round"/>',
               text(at + 5, (from + to) / 2 + 4, `${gainText(gain)}×`,
                    {size: 12, fill: looks.farhorizon.colour, weight: 600}));
  }
  for (const tool of [...tools.map(tool => tool.id), 'farhorizon']) {
    const own = drawn.filter(e => e.tool === tool).sort((a, b) => b.asked - a.asked);
    const {colour, mark: kind} = looks[tool];
    const main = tool === 'farhorizon';
    const places = own.map(e => [across.at(e.vertical_rms_m), up.at(e.silhouette_rms_m)]);
    if (places.length > 1)
      parts.push(`<path d="M${places.map(p => p.map(round).join()).join('L')}" fill="none" ` +
                 `stroke="${colour}" stroke-width="${main ? 2.6 : 1.3}" stroke-linejoin="round" ` +
                 `stroke-opacity="${main ? 1 : .75}"/>`);
    for (const [px, py] of places) parts.push(mark(kind, px, py, main ? 5.5 : 3.6, colour));
  }
  // The first and the last size of the uppermost line, so that theirs can be read off, too.
  const ends = drawn.filter(e => e.tool === 'lt').sort((a, b) => b.asked - a.asked);
  for (const entry of ends.length > 1 ? [ends[0], ends.at(-1)] : [])
    parts.push(text(across.at(entry.vertical_rms_m), up.at(entry.silhouette_rms_m) - 9,
                    percent(shareOf(contest, entry.asked)),
                    {size: 10.5, fill: looks.lt.colour, anchor: 'middle'}));
  for (const entry of ours)
    parts.push(text(across.at(entry.vertical_rms_m) + 9, up.at(entry.silhouette_rms_m) + 14,
                    percent(shareOf(contest, entry.asked)), {size: 11.5, fill: ink}));
  return parts.join('\n');
}

function legend(contests, x, y, width) {
  const there = [{id: 'farhorizon', name: 'farhorizon'}, ...tools].filter(
    tool => contests.some(contest => contest.entries.some(entry => entry.tool === tool.id)));
  const parts = [];
  let at = x, line = y;
  for (const {id, name} of there) {
    const room = 24 + (id === 'farhorizon' ? 6.4 : 5.9) * name.length + 14;
    if (at + room > x + width && at > x) {
      at = x;
      line += 22;
    }
    const {colour, mark: kind} = looks[id];
    parts.push(`<path d="M${at},${line - 4}h18" stroke="${colour}" stroke-width="2"/>`,
               mark(kind, at + 9, line - 4, id === 'farhorizon' ? 5 : 4, colour),
               text(at + 24, line, name, {weight: id === 'farhorizon' ? 600 : 400}));
    at += room;
  }
  return {drawn: parts.join('\n'), bottom: line};
}

/** The picture of all contests, as SVG. */
export function front(contests) {
  const alone = contests.length === 1;
  const margin = 28, gap = 34, columns = alone ? 1 : 2;
  const width = 860, inner = width - 2 * margin;
  const each = {width: (inner - gap * (columns - 1)) / columns, height: alone ? 470 : 380};
  const key = legend(contests, margin, 84, inner);
  const top = key.bottom + 26;
  const rows = Math.ceil(contests.length / columns);
  const height = top + rows * each.height + (rows - 1) * gap + margin - 8;
  const panels = contests.map((contest, i) => panel(contest, {
    x: margin + (i % columns) * (each.width + gap),
    y: top + Math.floor(i / columns) * (each.height + gap),
    ...each,
  }));
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${round(height)}" ` +
    `width="${width}" height="${round(height)}" ${font} role="img" ` +
    'aria-label="Vertical against silhouette error of the levels of several tools">\n' +
    `<rect width="${width}" height="${round(height)}" rx="12" fill="${paper}" ` +
    `stroke="${faint}"/>\n` +
    text(margin, 38, 'Skyline and ground at the same number of triangles',
         {size: 19, weight: 650}) + '\n' +
    text(margin, 58, 'A point a size, per cent of the DEM\'s triangles; lower left is better. ' +
         'Dotted: how far below the best of the others.', {size: 12.5, fill: quiet}) + '\n' +
    `${key.drawn}\n${panels.join('\n')}\n</svg>\n`;
}
