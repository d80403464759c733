// Chromium without a GPU, and what is asked of every page: no error in its console, no request that
// fails or goes elsewhere, and a picture with terrain.
import { createRequire } from 'node:module';
import { join } from 'node:path';

const kFlags = [
  '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
  '--ignore-gpu-blocklist', '--disable-background-networking', '--disable-component-update',
];

export const launch = (packages, executablePath) => {
  const { chromium } = createRequire(join(packages, 'x.js'))('playwright-core');
  return chromium.launch({ executablePath, args: kFlags });
};

// A page that notes what goes wrong in `faults`. base: the only host that it may ask.
export const openPage = async (browser, base, { width, height, scheme = 'light' }) => {
  const context = await browser.newContext({ viewport: { width, height }, colorScheme: scheme });
  const page = await context.newPage();
  page.setDefaultTimeout(120_000);
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

// The share of pixels of a picture that are not of the colour `sky`, and how many colours they
// have; the page itself reads the picture.
export const shareOf = (page, png, sky) => page.evaluate(async ([bytes, background]) => {
  const binary = Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0));
  const blob = new Blob([binary], { type: 'image/png' });
  const picture = await createImageBitmap(blob);
  const context = new OffscreenCanvas(picture.width, picture.height).getContext('2d');
  context.drawImage(picture, 0, 0);
  const { data } = context.getImageData(0, 0, picture.width, picture.height);

  const colours = new Set();
  let count = 0;
  for (let at = 0; at < data.length; at += 4) {
    const off = background.reduce((sum, value, k) => sum + Math.abs(data[at + k] - value), 0);
    if (off < 24) continue;
    count += 1;
    colours.add((data[at] << 16) | (data[at + 1] << 8) | data[at + 2]);
  }
  return { share: count / (data.length / 4), colours: colours.size };
}, [png.toString('base64'), sky]);
