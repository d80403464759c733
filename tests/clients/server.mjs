// A web server on loopback for folders under names, without anything that our service does.
import { createReadStream, existsSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';

const kTypes = {
  '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.json': 'application/json',
  '.geojson': 'application/geo+json', '.wasm': 'application/wasm', '.glb': 'model/gltf-binary',
  '.png': 'image/png', '.svg': 'image/svg+xml', '.terrain': 'application/vnd.quantized-mesh',
};

// folders: [name, path]; gives the address, and a function that closes the server.
export const serve = async (folders) => {
  const server = createServer((request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url, 'http://x').pathname));
    const [, name, ...rest] = path.split('/');
    const folder = folders.find(([one]) => one === name)?.[1];
    const file = folder && join(folder, ...rest);
    if (!file || !existsSync(file) || !statSync(file).isFile()) {
      response.writeHead(404);
      return response.end();
    }
    const type = kTypes[extname(file)] ?? 'application/octet-stream';
    // Terrain is in gzip on disk, as the README tells those who serve it to say.
    const encoding = extname(file) === '.terrain' ? { 'content-encoding': 'gzip' } : {};
    response.writeHead(200, { 'content-type': type, ...encoding });
    return createReadStream(file).pipe(response);
  });
  await new Promise((done) => { server.listen(0, '127.0.0.1', done); });
  return { base: `http://127.0.0.1:${server.address().port}`, close: () => server.close() };
};
