// node contest.mjs --cache DIR --farhorizon FILE [OPTIONS] DEM...        called by `run`, which see
import fs from 'node:fs';
import path from 'node:path';
import {parseArgs} from 'node:util';

import {Dem} from './dem.mjs';
import {front} from './front.mjs';
import {ourLevels, takesTriangles} from './ours.mjs';
import {say} from './programs.mjs';
import {tables} from './tables.mjs';
import {tools} from './tools.mjs';

const {values: options, positionals: files} = parseArgs({
  allowPositionals: true,
  options: {
    'cache': {type: 'string'},
    'farhorizon': {type: 'string'},
    'shares': {type: 'string', default: '20,10,5,2,1'},
    'default-levels': {type: 'boolean', default: false},
    'limit': {type: 'string', default: '300'},
    'picture': {type: 'string'},
  },
});

function misused(message) {
  say(message);
  process.exit(2);
}
const shares = options.shares.split(',').map(Number).sort((a, b) => b - a);
if (!shares.every(share => share > 0 && share < 100))
  misused(`--shares takes per cent between 0 and 100, such as 20,10,5: '${options.shares}'`);
const limit = Number(options.limit);
if (!(limit > 0)) misused(`--limit takes seconds: '${options.limit}'`);

/**
 * Where the judge sees more than report.json owns up to: its silhouette bound is never exceeded,
 * except on the outline, which it measures apart. A tenth of a millimetre is the rounding of
 * float32 files.
 */
function doubts(levels) {
  return levels.flatMap(({said, silhouette_max_m: seen}, level) => {
    const bound = said.silhouette_error_m.max;
    return seen <= bound + 1e-4 ? [] :
        [`farhorizon, level ${level}: a silhouette error of ${seen.toFixed(4)} m off the outline, ` +
         `where report.json says at most ${bound} m`];
  });
}

/** Falling, each once, none of nothing. */
const sizesOf = numbers => [...new Set(numbers)].filter(Boolean).sort((a, b) => b - a);

/**
 * One DEM's contest: {name, about, columns, sizes, ours, notes, entries: [{tool, name, best, asked,
 * triangles, ...}]}.
 */
async function contestOf(file, bySize) {
  const dem = await Dem.open(file, options);
  const entries = [], notes = [];
  // What the columns of the summary are: shares, or levels.
  let columns = shares.map(
    share => ({label: `${share} %`, size: Math.round(dem.about.triangles * share / 100)}));
  let sizes = sizesOf(columns.map(column => column.size));
  let ours;
  try {
    ours = await ourLevels(options.farhorizon, dem, bySize ? sizes : undefined);
    const judged = await dem.judge(ours.levels.map(level => level.file), {keep: false});
    judged.forEach((result, i) => Object.assign(ours.levels[i], result));
    if (!bySize) {
      columns = ours.levels.map(({triangles}, i) => ({label: `level ${i}`, size: triangles}));
      sizes = sizesOf(columns.map(column => column.size));
    }
    notes.push(...doubts(ours.levels));
    if (sizes.length !== ours.levels.length && bySize)
      throw new Error(`farhorizon made ${ours.levels.length} levels for ${sizes.length} sizes`);
    ours.levels.forEach((level, i) => {
      const asked = bySize ? sizes[i] : level.triangles;
      entries.push({tool: 'farhorizon', name: 'farhorizon', ...level, asked});
    });
  } catch (error) {
    notes.push(error.message);
  }
  for (const tool of tools) {
    const {meshes, why} = await dem.meshesOf(tool.id, sizes, limit);
    if (why) notes.push(why);
    const judged = await dem.judge(meshes.map(mesh => mesh.file), {keep: true});
    meshes.forEach((mesh, i) => entries.push(
      {tool: tool.id, name: tool.name, best: tool.best, ...mesh, ...judged[i]}));
  }
  return {name: dem.name, about: dem.about, columns, sizes, ours, entries, notes};
}

const bySize = !options['default-levels'] && await takesTriangles(options.farhorizon);
if (!bySize && !options['default-levels'])
  say('this farhorizon has no --triangles: judging its default levels, the others at as many ' +
      'triangles, in place of --shares');
const contests = [];
let failed = false;
for (const file of files) {
  try {
    contests.push(await contestOf(file, bySize));
    failed ||= !contests.at(-1).entries.some(entry => entry.tool === 'farhorizon');
  } catch (error) {
    say(error.message);
    failed = true;
  }
}
if (!contests.length) process.exit(1);
console.log(tables(contests));
const results = path.join(options.cache, 'results.json');
const picture = options.picture ?? path.join(options.cache, 'front.svg');
fs.writeFileSync(results, JSON.stringify(contests, null, 1));
fs.writeFileSync(picture, front(contests));
say(`all figures: ${results}; the front: ${picture}`);
process.exitCode = failed ? 1 : 0;
