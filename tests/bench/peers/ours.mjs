// farhorizon's levels of a DEM, decoded from the files that it wrote and laid over the grid.
import fs from 'node:fs';
import path from 'node:path';
import {fileURLToPath} from 'node:url';

import {lastWords, must, readJson, runProgram, say} from './programs.mjs';

const here = path.dirname(fileURLToPath(import.meta.url));

/** Whether this farhorizon makes levels of a given size. */
export async function takesTriangles(farhorizon) {
  const help = await must([farhorizon, 'build', '--help']);
  return /--triangles\b/.test(help);
}

/**
 * Builds the DEM's levels, of `sizes` triangles or by default, and returns {levels: [{file, bytes,
 * said}], finest first; seconds, peak, stages}: `said` is what report.json says of the level; the
 * seconds of one core and the peak of memory, MiB, are those of the whole build. The contest is
 * about shapes: heights are taken as they are and the datum for WGS 84, so that the way from the
 * Earth back to the grid is the map's projection alone.
 */
export async function ourLevels(farhorizon, dem, sizes) {
  const out = path.join(dem.folder, 'farhorizon');
  fs.rmSync(out, {recursive: true, force: true});
  const timings = path.join(dem.folder, 'timings.json');
  const build = [farhorizon, 'build', dem.file, '-o', out, '--formats', '3dtiles,drc',
                 '--vertical-datum', 'ellipsoid', '--threads', '1', '--progress', 'none',
                 '--timings', timings];
  if (dem.about.system_to_state) build.push('--crs', dem.about.system_to_state);
  if (sizes) build.push('--triangles', sizes.join());
  say(`${dem.name}: farhorizon${sizes ? '' : ', its default levels'}`);
  const begin = performance.now();
  const done = await runProgram(build);
  const seconds = (performance.now() - begin) / 1000;
  if (done.status !== 0) throw new Error(lastWords(done));

  const report = readJson(path.join(out, 'report.json'));
  const levels = [];
  for (let level = 0; fs.existsSync(path.join(out, `lod${level}.drc`)); ++level) {
    const drc = path.join(out, `lod${level}.drc`), file = path.join(out, `lod${level}.mesh`);
    const earth = path.join(out, `lod${level}.earth`);
    await must([process.execPath, path.join(here, 'drc_earth.mjs'), path.join(out, 'tileset.json'),
                drc, earth]);
    await must([path.join(dem.programs, 'over_grid'), dem.file, earth, file]);
    const bytes = Object.fromEntries(['drc', 'glb'].map(
        kind => [kind, fs.statSync(path.join(out, `lod${level}.${kind}`)).size]));
    levels.push({file, bytes, said: report.levels[level]});
  }
  return {levels, seconds, peak: done.peak, stages: readJson(timings)};
}
