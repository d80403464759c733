// node clients.mjs CACHE FARHORIZON CHROMIUM DEM DIR…      (see run)
import { mkdirSync, writeFileSync } from 'node:fs';
import { basename, dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { launch, openPage, shareOf } from './browser.mjs';
import { checkKeys, checkPages, checkStandalone } from './pages.mjs';
import { serve } from './server.mjs';
import { checkTileset, validateGlbs } from './validate.mjs';

const [cache, farhorizon, chromium, dem, ...dirs] = process.argv.slice(2);
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

// What clients draw the sky in: no terrain has that colour.
const kSky = [255, 0, 255];
// From above, where much of the picture is terrain, and from outside, nearly level.
const kLooks = {
  above: { heading: 0, pitch: -50, range: 1.6, least: 0.2 },
  outside: { heading: 120, pitch: -2, range: 1.4, least: 0.005 },
};

const checkClient = async (browser, base, dir, index, client) => {
  for (const [name, look] of Object.entries(kLooks)) {
    const { page, faults, close } = await openPage(browser, base, { width: 1280, height: 720 });
    const began = Date.now();
    await page.goto(`${base}/clients/${client}.html?tileset=/data${index}/tileset.json` +
      `&heading=${look.heading}&pitch=${look.pitch}&range=${look.range}`);
    const result = await page.waitForFunction(() => globalThis.result)
      .then((handle) => handle.jsonValue())
      .catch(() => ({ client, failures: ['the tiles do not settle in two minutes'] }));
    const took = Date.now() - began;
    const png = await page.screenshot();
    writeFileSync(join(pictures, `${basename(dir)}-${client}-${name}.png`), png);
    const { share, colours } = await shareOf(page, png, kSky);
    if (share < look.least || colours < 20) faults.push('the picture is empty');
    report(`${basename(dir)} in ${result.client}, from ${name}`, [...result.failures, ...faults],
      `${result.tiles} tiles, ${result.triangles} triangles, ${(100 * share).toFixed(1)} % of the ` +
      `picture, settled after ${took} ms`);
    await close();
  }
};

for (const dir of dirs) {
  const { count, version, faults } = await validateGlbs(dir, packages);
  if (count === 0) faults.push('there is no GLB');
  report(`${basename(dir)}: glTF validator ${version}`, faults, `${count} files`);
  const tileset = checkTileset(join(dir, 'tileset.json'));
  report(`${basename(dir)}: tileset.json`, tileset.faults, `${tileset.count} tiles`);
}

const browser = await launch(packages, chromium);
const server = await serve([
  ['clients', here], ['npm', packages], ['cesium', join(cache, 'cesium')],
  ...dirs.map((dir, i) => [`data${i}`, dir])]);
try {
  for (const [i, dir] of dirs.entries()) {
    for (const client of ['cesium', 'three']) {
      await checkClient(browser, server.base, dir, i, client);
    }
  }
  await checkStandalone({ browser, farhorizon, dir: dirs[0], cache, report });
  await checkPages({ browser, farhorizon, dem, cache, pictures, report });
  await checkKeys({ browser, farhorizon, dem, cache, pictures, report });
} catch (failure) {
  report('the run itself', [failure.message.split('\n')[0]]);
} finally {
  await browser.close();
  server.close();
}
console.log(`${failed ? `${failed} failed` : 'All passed'}; pictures are in ${pictures}`);
process.exit(failed ? 1 : 0);
