// node clients.mjs CACHE FARHORIZON CHROMIUM DEM BUILD…      (see run)
// BUILD: DIR or DIR=DEM, a folder that build has made and what it was made of.
import { mkdirSync } from 'node:fs';
import { basename, dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { launch } from './browser.mjs';
import { checkCesium, checkThree } from './draw.mjs';
import { checkFiles, readDem } from './files.mjs';
import { checkGlobe } from './globe.mjs';
import { checkKeys, checkPages, checkSplit, checkStandalone } from './pages.mjs';
import { serve } from './server.mjs';
import { makeSplit } from './split.mjs';

const [cache, farhorizon, chromium, dem, ...given] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const packages = join(cache, 'npm', 'node_modules');
const pictures = join(cache, 'pictures');
mkdirSync(pictures, { recursive: true });

let failed = 0;
const report = (what, faults, said = '') => {
  failed += faults.length > 0 ? 1 : 0;
  console.log(`${faults.length ? 'FAILED' : 'ok    '} ${what}${said && `: ${said}`}`);
  for (const fault of faults.slice(0, 10)) console.log(`         ${fault}`);
};

const builds = given.map((text, i) => {
  const [dir, of] = text.split('=');
  return { dir, dem: of ?? null, folder: `data${i}` };
});

const browser = await launch(packages, chromium);
const split = join(cache, 'made');
const server = await serve([
  ['clients', here], ['npm', packages], ['cesium', join(cache, 'cesium')],
  ['split', join(split, 'split')],
  ...builds.map(({ folder, dir }) => [folder, dir])]);
const attempt = async (what, work) => {
  try {
    await work();
  } catch (failure) {
    report(what, [failure.message.split('\n')[0]]);
  }
};
for (const build of builds) {
  const name = basename(build.dir);
  await attempt(name, async () => {
    const posts = readDem(build, report);
    const files = await checkFiles({ ...build, posts, packages, report });
    const context = { ...build, ...files, browser, base: server.base, posts, pictures, report };
    await attempt(`${name} in CesiumJS`, () => checkCesium(context));
    await attempt(`${name} in three.js`, () => checkThree(context));
    if (files) await attempt(`${name} as terrain in CesiumJS`, () => checkGlobe(context));
  });
}
const common = { browser, farhorizon, cache, pictures, report };
await attempt('viewer.html on its own', () => checkStandalone({ ...common, dir: builds[0].dir }));
await attempt('a level in parts', async () => {
  const dir = makeSplit({ farhorizon, dem, folder: split });
  await checkFiles({ dir, posts: null, packages, report });
  const context = {
    dir, folder: 'split', browser, base: server.base, posts: null, pictures, report,
  };
  await checkCesium(context);
  await checkThree(context);
  await checkSplit({ ...common, dir });
});
await attempt('the pages', () => checkPages({ ...common, dem }));
await attempt('the pages with keys', () => checkKeys({ ...common, dem }));
await browser.close();
server.close();
console.log(`${failed ? `${failed} failed` : 'All passed'}; pictures are in ${pictures}`);
process.exit(failed ? 1 : 0);
