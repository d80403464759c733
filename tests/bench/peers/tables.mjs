// The tables of the contest, as Markdown.
import {tools} from './tools.mjs';

/** Three digits that matter, and no more after the point than they need. */
export function number(value) {
  if (value === undefined) return '–';
  if (value === 0) return '0';
  if (value < 5e-5) return '<0.0001';
  if (value >= 100) return Math.round(value).toLocaleString('en');
  return value.toFixed(Math.min(4, Math.max(0, 2 - Math.floor(Math.log10(value)))));
}
export const count = value => value.toLocaleString('en');
export const percent = share => `${Number(share.toPrecision(2))} %`;
export const shareOf = ({about}, size) => 100 * size / about.triangles;

const table = rows => {
  const [head, ...body] = rows.map(row => `| ${row.join(' | ')} |`);
  return [head, `|${'---|'.repeat(rows[0].length)}`, ...body].join('\n');
};

/**
 * How an entry compares with the best of the others at the same size, each error by itself: `gain`,
 * their silhouette rms over ours; `vertical` and `facets`, ours over theirs. An error below a
 * millionth of a cell, or a thousandth of a degree, counts as that much: below is rounding. Nothing
 * where ours has more triangles than were asked for: that would be no contest.
 */
export function against(contest, ours) {
  const others = contest.entries.filter(entry => entry.best && entry.asked === ours.asked);
  if (!others.length || ours.triangles > ours.asked) return undefined;
  const nothing = 1e-6 * Math.min(contest.about.cell_x_m, contest.about.cell_y_m);
  const ratio = (key, floor) => Math.max(ours[key], floor) /
      Math.max(Math.min(...others.map(entry => entry[key])), floor);
  return {
    gain: 1 / ratio('silhouette_rms_m', nothing),
    vertical: ratio('vertical_rms_m', nothing),
    facets: ratio('facet_angle_rms_deg', 1e-3),
  };
}
/** Two digits: more would be noise. */
export const gainText = value => value >= 9.95 ? value.toFixed(0) : value.toFixed(1);

/** Of each DEM a row: gain and vertical at each share, or of each level. */
function summary(contests) {
  const judged = contests.filter(contest => contest.ours);
  if (!judged.length) return '';
  const labels = [...new Set(judged.flatMap(({columns}) => columns.map(column => column.label)))];
  const rows = judged.map(contest => [contest.name, ...labels.map(label => {
    const size = contest.columns.find(column => column.label === label)?.size;
    const ours = contest.entries.find(e => e.tool === 'farhorizon' && e.asked === size);
    const ratios = ours && against(contest, ours);
    if (!ratios) return '–';
    const share = label.endsWith('%') ? '' : `${percent(shareOf(contest, size))}: `;
    return `${share}${gainText(ratios.gain)} / ${ratios.vertical.toFixed(2)}`;
  })]);
  return `## farhorizon against the best of the others

Gain / vertical, each error against the best of the others by itself: how many times lower the
silhouette rms is, and the vertical rms as a multiple of theirs.

${table([['DEM', ...labels], ...rows])}`;
}

/** Each tool's errors at each size. */
function errors(contest) {
  const names = [{id: 'farhorizon', name: 'farhorizon'}, ...tools].filter(
    tool => contest.entries.some(entry => entry.tool === tool.id));
  const rows = contest.sizes.map(size => [
    `${count(size)} (${percent(shareOf(contest, size))})`,
    ...names.map(({id}) => {
      const entry = contest.entries.find(e => e.tool === id && e.asked === size);
      if (!entry) return '–';
      const errors = `${number(entry.silhouette_rms_m)} / ${number(entry.vertical_rms_m)}`;
      const far = Math.abs(entry.triangles / size - 1) > 0.02;
      return far ? `${errors} (${count(entry.triangles)})` : errors;
    }),
  ]);
  return table([['triangles', ...names.map(tool => tool.name)], ...rows]);
}

/** What else is judged, ours beside the best (or least) of the others. */
function looks(contest) {
  const rows = contest.sizes.map(size => {
    const ours = contest.entries.find(e => e.tool === 'farhorizon' && e.asked === size);
    const others = contest.entries.filter(entry => entry.best && entry.asked === size);
    const least = key => others.length ? number(Math.min(...others.map(e => e[key]))) : '–';
    const highest = e => Math.max(e.silhouette_max_m, e.silhouette_rim_max_m);
    const bytes = kind => (ours.bytes[kind] / ours.triangles).toFixed(2);
    const ratios = ours && against(contest, ours);
    return [
      count(size),
      ratios ? `${gainText(ratios.gain)} / ${ratios.vertical.toFixed(2)}` : '–',
      ours ? `${number(ours.facet_angle_rms_deg)} · ${least('facet_angle_rms_deg')} (` +
             `${ratios?.facets.toFixed(2) ?? '–'})` : '–',
      ours ? `${number(ours.needles_percent)} · ${least('needles_percent')}` : '–',
      ours ? `${number(highest(ours))} · ` +
             (others.length ? number(Math.min(...others.map(highest))) : '–') : '–',
      ours ? `${number(ours.vertical_max_m)} · ${least('vertical_max_m')}` : '–',
      ours ? `${bytes('drc')} · ${bytes('glb')}` : '–',
    ];
  });
  return table([['triangles', 'gain / vertical', 'facets off, degrees: ours · best (ratio)',
                 'needles, %: ours · least', 'greatest silhouette error, m: ours · least',
                 'greatest vertical error, m: ours · least', 'bytes a triangle: .drc · .glb'],
                ...rows]);
}

function times(contest) {
  const {seconds, levels, stages, peak} = contest.ours ?? {};
  const ours = contest.ours ? `farhorizon ${number(seconds)} for ${levels.length} levels with ` +
      `horizon, proof and files, of it ${number(stages.simplify)} simplifying, ` +
      `${number(peak)} MiB; ` : '';
  const others = tools.flatMap(tool => {
    const took = contest.entries.filter(e => e.tool === tool.id).map(e => e.seconds);
    if (!took.length) return [];
    const low = number(Math.min(...took)), high = number(Math.max(...took));
    return `${tool.name} ${low === high ? low : `${low} to ${high}`}`;
  });
  return `Seconds of one core: ${ours}the others for one mesh, meshing alone: ` +
         `${others.join(', ')}.`;
}

function detail(contest) {
  const {about, notes} = contest;
  const missing = about.missing_posts ? `, ${count(about.missing_posts)} of them missing` : '';
  const uncovered = contest.entries.filter(entry => entry.posts_uncovered > 0);
  const said = [...notes.map(note => `${note}.`)];
  if (uncovered.length) {
    const most = Math.max(...uncovered.map(entry => entry.posts_uncovered));
    const names = [...new Set(uncovered.map(entry => entry.name))];
    said.push(`Some meshes leave posts uncovered, which is in none of their errors: ` +
              `${names.join(', ')}, ${most} posts at most.`);
  }
  return `## ${contest.name}

${about.columns} x ${about.rows} posts${missing}, ${number(about.cell_x_m)} x \
${number(about.cell_y_m)} m, ${count(about.triangles)} triangles. Silhouette rms / vertical rms, \
metres:

${errors(contest)}

${contest.ours ? `${looks(contest)}\n\n` : ''}${times(contest)}
${said.length ? `\n${said.map(line => `- ${line}`).join('\n')}\n` : ''}`;
}

export const tables = contests =>
  [summary(contests), ...contests.map(detail)].filter(Boolean).join('\n\n');
