// A DEM of the contest, and what other tools make of it: made once for each size, and kept.
import crypto from 'node:crypto';
import fs from 'node:fs';
import path from 'node:path';
import {fileURLToPath} from 'node:url';

import {lastWords, must, readJson, runProgram, say} from './programs.mjs';

const here = path.dirname(fileURLToPath(import.meta.url));

/** What makes a mesh: another of these, and the meshes that are kept are of no use. */
const makers = ['package.json', 'npm_meshes.mjs', 'grid.mjs', 'cgal_meshes.cpp', 'grid.h',
                'grid.cpp'];
/** What a judgement depends on. */
const judges = ['judge.cpp', 'skylines.h', 'skylines.cpp', 'surfaces.h', 'surfaces.cpp', 'grid.h',
                'grid.cpp'];

function hashOf(files) {
  const hash = crypto.createHash('sha256');
  for (const file of files) hash.update(fs.readFileSync(file)).update('\0');
  return hash.digest('hex').slice(0, 16);
}
const sources = names => names.map(name => path.join(here, name));

const lines = text => text.split('\n').filter(Boolean).map(line => JSON.parse(line));

/** A DEM in the cache: a folder named after its heights, with its grid and the others' meshes. */
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
   * The meshes of one tool, [{asked, triangles, seconds, file}], and `why` some are not there.
   * Makes those that no earlier run has made; what did not end within `limit` seconds is tried
   * again only with a higher limit.
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

  /** Judges mesh files. `keep`: they are the others', which an earlier run may have judged. */
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
