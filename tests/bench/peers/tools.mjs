// The tools of the contest, and their meshes, which are made once for each DEM and size and kept.
import {spawn} from 'node:child_process';
import crypto from 'node:crypto';
import fs from 'node:fs';
import path from 'node:path';
import {fileURLToPath} from 'node:url';

const here = path.dirname(fileURLToPath(import.meta.url));

/**
 * In the order of the tables. `best`: counts where "the best of the others" is asked for; martini
 * does not, for it takes no number of triangles and only square grids of 2^k + 1 posts.
 */
export const tools = [
  {id: 'delatin', name: 'delatin', best: true},
  {id: 'martini', name: 'martini', best: false},
  {id: 'meshoptimizer', name: 'meshoptimizer, border locked', best: true},
  {id: 'meshoptimizer-free', name: 'meshoptimizer', best: true},
  {id: 'lt', name: 'CGAL Lindstrom-Turk', best: true},
  {id: 'gh', name: 'CGAL Garland-Heckbert', best: true},
];

/** What makes a mesh: another of these, and the meshes that are kept are of no use. */
const makers = ['package.json', 'npm_meshes.mjs', 'grid.mjs', 'cgal_meshes.cpp', 'grid.h', 'grid.cpp'];
const judges = ['judge.cpp', 'skylines.h', 'skylines.cpp', 'surfaces.h', 'surfaces.cpp', 'grid.h',
                'grid.cpp'];

function hashOf(files) {
  const hash = crypto.createHash('sha256');
  for (const file of files) hash.update(fs.readFileSync(file)).update('\0');
  return hash.digest('hex').slice(0, 16);
}
const sources = names => names.map(name => path.join(here, name));

export function say(message) {
  process.stderr.write(`peers: ${message}\n`);
}

/** The most memory that a running process has had, MiB; undefined once it is gone. */
function peakOf(pid) {
  try {
    const [, kib] = /VmHWM:\s*(\d+)/.exec(fs.readFileSync(`/proc/${pid}/status`, 'utf8')) ?? [];
    return kib && kib / 1024;
  } catch {
    return undefined;
  }
}

/**
 * {status, stdout, stderr, stopped, peak}: `stopped` where the limit of seconds ended it, `peak` its
 * memory in MiB, but for what it took in its last twentieth of a second.
 */
export function runProgram(command, {limit} = {}) {
  return new Promise((resolve, reject) => {
    const child = spawn(command[0], command.slice(1), {stdio: ['ignore', 'pipe', 'pipe']});
    let stdout = '', stderr = '', stopped = false, peak = 0;
    const clock = limit && setTimeout(() => { stopped = true; child.kill(); }, 1000 * limit);
    const look = setInterval(() => peak = peakOf(child.pid) ?? peak, 50);
    child.stdout.on('data', data => stdout += data);
    child.stderr.on('data', data => stderr += data);
    child.on('error', reject);
    child.on('close', status => {
      clearTimeout(clock);
      clearInterval(look);
      resolve({status, stdout, stderr, stopped, peak});
    });
  });
}

/** What a program said of its failure: node's own errors are lines before the last. */
export function lastWords({stderr, status}) {
  const said = stderr.trim().split('\n');
  return said.find(line => /^\w*Error\b/.test(line)) || said.at(-1) || `exit status ${status}`;
}

/** Runs what has to succeed. */
export async function must(command, options) {
  const done = await runProgram(command, options);
  if (done.status === 0) return done.stdout;
  throw new Error(lastWords(done));
}

export const readJson = (file, otherwise) =>
  fs.existsSync(file) || otherwise === undefined ? JSON.parse(fs.readFileSync(file)) : otherwise;
const lines = text => text.split('\n').filter(Boolean).map(line => JSON.parse(line));

/** A DEM in the cache: a folder named after its heights, with its grid and the meshes made of it. */
export class Dem {
  static async open(file, {cache}) {
    const dem = new Dem();
    dem.file = file;
    dem.name = path.basename(file).replace(/\.[^.]*$/, '');
    dem.programs = path.join(cache, 'programs');
    const grid = path.join(cache, `reading-${process.pid}.grid`);
    dem.about = JSON.parse(await must([path.join(dem.programs, 'dem_grid'), file, grid]));
    if (!dem.about.triangles) throw new Error(`${file}: no triangle of three posts with data`);
    const cell = [dem.about.cell_x_m, dem.about.cell_y_m].map(metres => metres.toFixed(6));
    dem.folder = path.join(cache, 'dems', `${hashOf([grid])}-${cell.join('x')}`);
    fs.mkdirSync(dem.folder, {recursive: true});
    dem.grid = path.join(dem.folder, 'dem.grid');
    fs.renameSync(grid, dem.grid);
    dem.asProgramsTakeIt = [dem.grid, `${dem.about.cell_x_m}`, `${dem.about.cell_y_m}`];
    return dem;
  }

  /**
   * The meshes of one tool, [{asked, triangles, seconds, file}], and `why` some are not there. Makes
   * those that no earlier run has made; what did not end within `limit` seconds is tried again only
   * with a higher limit.
   */
  async meshesOf(tool, sizes, limit) {
    const prefix = path.join(this.folder, `${tool}-${hashOf(sources(makers))}`);
    const made = readJson(`${prefix}.json`, {meshes: {}, gone: {}});
    const missing = sizes.filter(size => !made.meshes[size] && !(made.gone[size]?.limit >= limit));
    if (missing.length) {
      say(`${this.name}: ${tool}, ${missing.join(', ')} triangles (${limit} s at most)`);
      const isCgal = tool === 'lt' || tool === 'gh';
      const command = isCgal
          ? [path.join(this.programs, 'cgal_meshes'), ...this.asProgramsTakeIt, tool]
          : [process.execPath, '--max-old-space-size=8000', path.join(here, 'npm_meshes.mjs'),
             ...this.asProgramsTakeIt, tool];
      const done = await runProgram([...command, prefix, ...missing.map(String)], {limit});
      let why = `${tool} has no mesh of so few triangles`;
      for (const line of lines(done.stdout)) {
        if (line.cannot) why = line.cannot;
        else made.meshes[line.asked] = line;
      }
      const failed = done.status !== 0 && done.status !== 3 && !done.stopped;
      if (failed) why = `${tool} failed: ${lastWords(done)}`;
      if (done.stopped) why = `${tool} was stopped after ${limit} s`;
      for (const size of missing) {
        if (made.meshes[size]) delete made.gone[size];
        else made.gone[size] = {why, limit: done.stopped ? limit : failed ? 0 : Infinity};
      }
      fs.writeFileSync(`${prefix}.json`, JSON.stringify(made, (key, value) =>
        value === Infinity ? Number.MAX_VALUE : value, 1));
    }
    const meshes = sizes.filter(size => made.meshes[size])
                       .map(size => ({...made.meshes[size], file: `${prefix}-${size}.mesh`}));
    const why = sizes.map(size => made.gone[size]?.why).find(Boolean);
    return {meshes, why};
  }

  /** Judges mesh files; `keep`: those of the others, whose judgement an earlier run may have made. */
  async judge(files, {keep}) {
    const store = path.join(this.folder, `judged-${hashOf(sources(judges))}.json`);
    const known = keep ? readJson(store, {}) : {};
    const unknown = files.filter(file => !known[path.basename(file)]);
    if (unknown.length) {
      const judge = path.join(this.programs, 'judge');
      const said = lines(await must([judge, ...this.asProgramsTakeIt, ...unknown]));
      unknown.forEach((file, i) => known[path.basename(file)] = said[i]);
      if (keep) fs.writeFileSync(store, JSON.stringify(known, null, 1));
    }
    return files.map(file => known[path.basename(file)]);
  }
}
