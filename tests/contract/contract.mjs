// The whole run; tests/contract/run starts it.
//   node contract.mjs CACHE PROGRAM ROOT PORT
import { createRequire } from 'node:module';
import { join } from 'node:path';

import { checkCallbacks, startReceiver } from './callbacks.mjs';
import { checkClients } from './clients.mjs';
import { checkDocument, documentOf } from './document.mjs';
import { checkEts } from './ets.mjs';
import { checkInputs } from './inputs.mjs';
import { checkJobs } from './jobs.mjs';
import { checkUploads } from './uploads.mjs';
import { startService } from './service.mjs';
import { finish } from './verdict.mjs';

const [, , cache, program, root, port] = process.argv;
// What npm installed lies in the cache, not beside these files.
const packages = createRequire(join(cache, 'package.json'));

const receiver = await startReceiver();
const service = await startService(program, port, { env: receiver.env });
try {
  const run = { base: service.base, cache, root, packages, program };
  await checkDocument(run);
  run.document = await documentOf(run);
  await checkEts(run);
  await checkInputs(run);
  await checkJobs(run);
  await checkUploads(run);
  await checkCallbacks(run, receiver);
  await checkClients(run);
} finally {
  await service.stop();
  receiver.stop();
}
process.exit(finish());
