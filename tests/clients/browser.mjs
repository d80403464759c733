// Chromium without a GPU, and what is asked of every page: no error in its console, no request that
// fails or goes elsewhere.
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { readPng } from './picture.mjs';

const kFlags = [
  '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
  '--ignore-gpu-blocklist', '--disable-background-networking', '--disable-component-update',
];

// Milliseconds that anything may take, on a machine that does much else.
const kPatience = 300_000;

export const launch = (packages, executablePath) => {
  const { chromium } = createRequire(join(packages, 'x.js'))('playwright-core');
  return chromium.launch({ executablePath, args: kFlags });
};

// A page that notes what goes wrong in `faults`. base: the only host that it may ask.
export const openPage = async (browser, base, { width, height, scheme = 'light' }) => {
  const context = await browser.newContext({ viewport: { width, height }, colorScheme: scheme });
  const page = await context.newPage();
  page.setDefaultTimeout(kPatience);
  const faults = [];
  page.on('console', (message) => { if (message.type() === 'error') faults.push(message.text()); });
  page.on('pageerror', (failure) => faults.push(String(failure)));
  page.on('requestfailed', (request) => {
    // What a page itself gives up is no fault of the server.
    const cause = request.failure()?.errorText;
    if (cause !== 'net::ERR_ABORTED') faults.push(`${request.url()}: ${cause}`);
  });
  page.on('request', (request) => {
    if (!new RegExp(`^(${base}/|data:|blob:)`).test(request.url())) {
      faults.push(`asks elsewhere: ${request.url()}`);
    }
  });
  page.on('response', (response) => {
    if (response.status() >= 400) faults.push(`${response.url()}: ${response.status()}`);
  });
  return { page, faults, close: () => context.close() };
};

// A page of this folder with what it says of itself in `client`, and what is asked of that:
// ask('look', view) calls client.look(view).
export const openClient = async (browser, base, page, query) => {
  const opened = await openPage(browser, base, { width: 1280, height: 720 });
  await opened.page.goto(`${base}/clients/${page}?${new URLSearchParams(query)}`);
  await opened.page.waitForFunction(() => globalThis.client);
  const ask = (name, ...given) => Promise.race([
    opened.page.evaluate(([what, ...rest]) => globalThis.client[what](...rest), [name, ...given]),
    new Promise((_, fail) => {
      setTimeout(() => fail(new Error(`${name} does not settle`)), kPatience).unref();
    }),
  ]);
  return {
    ...opened, ask, name: await opened.page.evaluate(() => globalThis.client.name),
    // What is seen; a file keeps it.
    shoot: async (file) => readPng(
      await opened.page.screenshot(file === undefined ? {} : { path: file })),
    allFaults: async () => [
      ...await opened.page.evaluate(() => globalThis.client.failures), ...opened.faults],
  };
};
