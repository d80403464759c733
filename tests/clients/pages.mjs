// The pages of the real service, used as people use them: a DEM goes in at /, its levels are looked
// at in the viewer, in light and dark, wide and on a phone.
import { spawn, spawnSync } from 'node:child_process';
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { tmpdir } from 'node:os';
import { openPage } from './browser.mjs';
import { readPng, shareOf } from './picture.mjs';
import { serve } from './server.mjs';

// The running service, once it says where it listens.
const startService = async (farhorizon, cesium, data) => {
  const service = spawn(farhorizon, ['serve', '--listen', '127.0.0.1:0', '--data', data], {
    env: { ...process.env, FARHORIZON_VIEWER_CESIUM: cesium, FARHORIZON_LOG_FORMAT: 'json' },
    stdio: ['ignore', 'pipe', 'pipe'],
  });
  const port = await new Promise((done, fail) => {
    let said = '';
    const hear = (bytes) => {
      said += bytes;
      const found = /"msg":"serving".*?"port":(\d+)/.exec(said);
      if (found) done(Number(found[1]));
    };
    service.stdout.on('data', hear);
    service.stderr.on('data', hear);
    service.on('exit', () => fail(new Error(`the service ended: ${said.slice(-500)}`)));
  });
  return { base: `http://127.0.0.1:${port}`, stop: () => service.kill('SIGTERM') };
};

// Of a job on a machine that does much else.
const kJobTime = 600_000;
const kKinds = [
  { width: 1280, height: 800, scheme: 'light' }, { width: 1280, height: 800, scheme: 'dark' },
  { width: 390, height: 844, scheme: 'light' }, { width: 390, height: 844, scheme: 'dark' },
];

// Sends the DEM by the page and waits until it is done; gives the viewer's address.
const sendDem = async ({ browser, base, dem, report }) => {
  const { page, faults, close } = await openPage(browser, base, kKinds[0]);
  await page.goto(`${base}/`);
  const began = Date.now();
  await page.getByText('Options').click();
  await page.getByLabel('Levels').fill('3');
  await page.setInputFiles('#file', dem);
  const row = page.locator('.job', { hasText: basename(dem) }).first();
  await row.waitFor();
  await page.waitForFunction(() => document.querySelector('.job')?.matches('.successful, .failed'),
    null, { polling: 50, timeout: kJobTime });
  const done = Date.now();
  if (!(await row.getAttribute('class')).includes('successful')) faults.push('the job has failed');
  await row.getByRole('button', { name: 'Artifacts' }).click();
  await page.locator('.artifacts a', { hasText: 'tileset.json' }).waitFor();
  await row.getByRole('link', { name: 'View' }).click();
  await page.waitForFunction(() => document.body.dataset.ready === 'true');
  await page.waitForFunction(() => farhorizon.scene.tileset.tilesLoaded
    && farhorizon.scene.tileset.statistics.selected > 0);
  const first = Date.now();
  report('a DEM by the page, to its first picture', faults,
    `done after ${done - began} ms, drawn ${first - began} ms after the file was chosen`);
  const address = page.url();
  await close();
  return address;
};

// A job as the browser's own EventSource has it, to the end of its stream: it does not connect again.
const followEvents = async ({ browser, base, dem, report }) => {
  const { page, faults, close } = await openPage(browser, base, kKinds[0]);
  await page.goto(`${base}/`);
  const { seen, closed } = await page.evaluate(async ([content, filename, time]) => {
    const body = Uint8Array.from(atob(content), (one) => one.charCodeAt(0));
    const job = await (await fetch(`/jobs?levels=1&filename=${filename}`, {
      method: 'POST', body, headers: { 'Content-Type': 'application/octet-stream' },
    })).json();
    const source = new EventSource(`/jobs/${job.jobID}/events`);
    const told = [];
    source.addEventListener('status', ({ data, lastEventId }) => {
      told.push({ ...JSON.parse(data), lastEventId });
    });
    const end = Date.now() + time;
    while (source.readyState !== EventSource.CLOSED && Date.now() < end) {
      await new Promise((done) => { setTimeout(done, 50); });
    }
    return { seen: told, closed: source.readyState === EventSource.CLOSED };
  }, [readFileSync(dem).toString('base64'), basename(dem), kJobTime]);
  const last = seen.at(-1)?.status;
  if (last !== 'successful') faults.push(`the last event has the status ${last}`);
  if (!closed) faults.push('the browser connects again and again after the job has ended');
  if (seen.some(({ progress }, i) => i > 0 && progress < seen[i - 1].progress)) {
    faults.push('progress goes back');
  }
  if (new Set(seen.map(({ lastEventId }) => lastEventId)).size !== seen.length) {
    faults.push('events are sent twice');
  }
  report('EventSource of the browser on a job', faults, `${seen.length} events, then closed`);
  await close();
};

const lookAtIndex = async ({ browser, base, pictures, report }, kind) => {
  const { page, faults, close } = await openPage(browser, base, kind);
  await page.goto(`${base}/`);
  await page.locator('.job').first().waitFor();
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  if (wide > kind.width) faults.push(`the page is ${wide} pixels wide`);
  await page.screenshot({ path: join(pictures, `page-${kind.scheme}-${kind.width}.png`) });
  report(`the page, ${kind.scheme}, ${kind.width} wide`, faults);
  await close();
};

// What is done in the viewer, by keys mostly; gives what it says of the skyline.
const useViewer = async ({ page, faults }, address, kind, pictures) => {
  const shoot = async (name) => {
    const path = join(pictures, `viewer-${name}-${kind.scheme}-${kind.width}.png`);
    writeFileSync(path, await page.screenshot());
  };
  await page.goto(address);
  await page.waitForFunction(() => document.body.dataset.ready === 'true');
  // Level 1 and its edges by azimuth.
  await page.keyboard.press('1');
  await page.waitForFunction(() => farhorizon.scene.shown === 1);
  await page.keyboard.press('h');
  await page.waitForFunction(() => farhorizon.scene.lines !== null);
  await page.keyboard.press('h');
  await page.waitForFunction(() => !document.getElementById('wheel').hidden
    && document.getElementById('notice').hidden);
  await page.waitForTimeout(1000);
  await shoot('edges');
  // The skyline of level 2 from outside.
  await page.keyboard.press('2');
  await page.getByRole('button', { name: 'Look west' }).click();
  await page.keyboard.press('c');
  await page.waitForFunction(() => /root mean square/.test(
    document.getElementById('difference').textContent));
  await page.waitForTimeout(500);
  await shoot('skyline');
  const said = await page.textContent('#difference');
  await page.keyboard.press('c');
  await page.keyboard.press('w');
  await page.keyboard.press('f');
  await page.waitForTimeout(1000);
  const { colours } = shareOf(readPng(await page.locator('#view').screenshot()), [0, 0, 0]);
  if (colours < 20) faults.push('the picture is empty');
  await shoot('wireframe');
  faults.push(...await page.evaluate(() => farhorizon.scene.failures));
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  if (wide > kind.width) faults.push(`the page is ${wide} pixels wide`);
  return said;
};
const lookAtViewer = async ({ browser, base, pictures, report, address }, kind) => {
  const opened = await openPage(browser, base, kind);
  const said = await useViewer(opened, address, kind, pictures)
    .catch((failure) => { opened.faults.push(failure.message.split('\n')[0]); });
  report(`the viewer, ${kind.scheme}, ${kind.width} wide`, opened.faults, said);
  await opened.close();
};

// The page that `farhorizon viewer` puts beside artifacts, on a server that knows nothing of it.
const openStandalone = async ({ browser, farhorizon, dir, cache }) => {
  const copy = join(cache, 'standalone');
  rmSync(copy, { recursive: true, force: true });
  cpSync(dir, copy, { recursive: true });
  const made = spawnSync(farhorizon, ['viewer', copy, '--cesium', join(cache, 'cesium')]);
  const server = await serve([['copy', copy]]);
  const { page, faults, close } = await openPage(browser, server.base, kKinds[0]);
  if (made.status !== 0) faults.push(made.stderr.toString());
  await page.goto(`${server.base}/copy/viewer.html`);
  await page.waitForFunction(() => document.body.dataset.ready === 'true')
    .catch((failure) => { faults.push(failure.message.split('\n')[0]); });
  return { page, faults, close: async () => { await close(); server.close(); } };
};
export const checkStandalone = async (context) => {
  const { faults, close } = await openStandalone(context);
  context.report('viewer.html on its own', faults);
  await close();
};

// The viewer on a tileset whose level 0 is in parts: all of them are shown, and are its skyline.
export const checkSplit = async (context) => {
  const { page, faults, close } = await openStandalone(context);
  await page.keyboard.press('0');
  await page.waitForFunction(() => farhorizon.scene.shown === 0 && farhorizon.scene.models.has(0));
  await page.waitForFunction(async () => (
    await farhorizon.scene.models.get(0)).some(({ show }) => show));
  const found = await page.evaluate(async () => {
    const { scene } = farhorizon;
    const models = await scene.modelsOf(0);
    scene.look(0);
    const columns = async (level) => (
      await scene.skylineOf(level)).filter((row) => !Number.isNaN(row)).length;
    return {
      contents: scene.levels.get(0).length, shown: models.filter(({ show }) => show).length,
      fine: await columns(0), coarse: await columns(1), failures: scene.failures,
      bytes: document.querySelector('#row-0 td:last-child').textContent,
    };
  });
  const { contents, shown, fine, coarse, failures, bytes } = found;
  faults.push(...failures);
  if (contents < 2) faults.push('level 0 is whole');
  if (shown !== contents) faults.push(`${shown} of ${contents} contents of level 0 are shown`);
  const { artifacts } = JSON.parse(readFileSync(join(context.dir, 'manifest.json'), 'utf8'));
  const sum = artifacts.filter(({ name }) => /^lod0-\d/.test(name))
    .reduce((total, one) => total + one.bytes, 0);
  if (!(Math.abs(Number(bytes) * 1000 - sum) < sum / 100)) {
    faults.push(`level 0 has ${sum} bytes, the page says ${bytes} kB`);
  }
  if (!(fine > 0 && Math.abs(fine - coarse) <= 2)) {
    faults.push(`level 0 is seen in ${fine} columns, level 1 in ${coarse}`);
  }
  await page.keyboard.press('h');
  await page.waitForFunction(() => farhorizon.scene.lines !== null);
  await page.screenshot({ path: join(context.pictures, 'viewer-parts.png') });
  context.report('viewer.html on a level in parts', faults,
    `${shown} contents, ${fine} columns of a skyline, ${bytes} kB`);
  await close();
};

// A service that asks for keys: the page asks for one, once, and all that it does works with that.
export const checkKeys = async ({ browser, farhorizon, dem, cache, pictures, report }) => {
  const data = mkdtempSync(join(tmpdir(), 'farhorizon-clients-'));
  const made = spawnSync(farhorizon, ['keys', 'add', '--name', 'clients', '--data', data]);
  const key = made.stdout.toString().trim();
  const service = await startService(farhorizon, join(cache, 'cesium'), data);
  const { page, faults, close } = await openPage(browser, service.base, kKinds[0]);
  const dialog = page.locator('dialog.key');
  const give = async (text) => {
    await dialog.getByLabel('Key').fill(text);
    await dialog.getByRole('button').click();
  };
  const use = async () => {
    await page.goto(`${service.base}/`);
    await dialog.waitFor();
    await page.screenshot({ path: join(pictures, 'keys-asked.png') });
    await give(`${key.slice(0, -1)}${key.endsWith('0') ? '1' : '0'}`);
    await dialog.getByText('not good').waitFor();
    await give(key);
    await page.getByText('Options').click();
    await page.getByLabel('Levels').fill('2');
    await page.setInputFiles('#file', dem);
    await page.waitForFunction(() => document.querySelector('.job')?.matches('.successful, .failed'),
      null, { polling: 50, timeout: kJobTime });
    await page.screenshot({ path: join(pictures, 'keys-given.png') });
    // Links, which have no header: a page that is opened, and a file that is downloaded.
    const row = page.locator('.job').first();
    await row.getByRole('button', { name: 'Artifacts' }).click();
    const [download] = await Promise.all([page.waitForEvent('download'),
      page.locator('.artifacts a', { hasText: 'tileset.json' }).click()]);
    if (await download.failure()) faults.push(`the download failed: ${await download.failure()}`);
    await row.getByRole('link', { name: 'Report', exact: true }).click();
    await page.waitForURL(/report\.html\?ticket=/);
    await page.locator('h1').waitFor();
    await page.goBack();
    await page.locator('.job').first().getByRole('link', { name: 'View', exact: true }).click();
    await page.waitForFunction(() => document.body.dataset.ready === 'true');
    await page.keyboard.press('1');
    await page.waitForFunction(() => farhorizon.scene.shown === 1);
    await page.keyboard.press('h');
    await page.waitForFunction(() => farhorizon.scene.lines !== null);
    await page.waitForTimeout(1000);
    writeFileSync(join(pictures, 'keys-viewer.png'), await page.screenshot());
    const { colours } = shareOf(readPng(await page.locator('#view').screenshot()), [0, 0, 0]);
    if (colours < 20) faults.push('the picture is empty');
    faults.push(...await page.evaluate(() => farhorizon.scene.failures));
    const kept = await page.evaluate(() => location.href + document.cookie +
      JSON.stringify(localStorage));
    if (kept.includes(key.slice(16))) faults.push('the key is kept elsewhere');
  };
  await use().catch((failure) => { faults.push(failure.message.split('\n')[0]); });
  // The first answer, and that to the wrong key, are 401.
  report('the pages of a service that asks for keys', faults.filter((fault) => !/401/.test(fault)));
  await close();
  service.stop();
  rmSync(data, { recursive: true, force: true });
};

export const checkPages = async ({ browser, farhorizon, dem, cache, pictures, report }) => {
  const data = mkdtempSync(join(tmpdir(), 'farhorizon-clients-'));
  const service = await startService(farhorizon, join(cache, 'cesium'), data);
  const common = { browser, base: service.base, dem, pictures, report };
  try {
    const address = await sendDem(common);
    for (const kind of kKinds) {
      await lookAtIndex(common, kind);
      await lookAtViewer({ ...common, address }, kind);
    }
    await followEvents(common);
  } finally {
    service.stop();
    rmSync(data, { recursive: true, force: true });
  }
};
