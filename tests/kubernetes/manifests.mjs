// node manifests.mjs CACHE FARHORIZON ROOT: see run.
import {spawnSync} from 'node:child_process';
import fs from 'node:fs';
import {createRequire} from 'node:module';
import path from 'node:path';

const [cache, farhorizon, root] = process.argv.slice(2);
const require = createRequire(path.join(cache, 'package.json'));
const YAML = require('yaml');

let failed = 0;
function check(what, holds, why = '') {
  console.log(`${holds ? 'ok    ' : 'FAILED'} ${what}${holds ? '' : `: ${why}`}`);
  failed += holds ? 0 : 1;
}

const folder = path.join(root, 'docker/kubernetes');
const read = (file) =>
  YAML.parseAllDocuments(fs.readFileSync(file, 'utf8'), {merge: true}).map((one) => one.toJSON());
const kustomization = read(path.join(folder, 'kustomization.yaml'))[0];
const files = fs.readdirSync(folder).filter((file) => file !== 'kustomization.yaml');
check('kustomization.yaml names every file',
      files.sort().join() === [...kustomization.resources].sort().join());
const objects = files.flatMap((file) => read(path.join(folder, file)));
const called = (kind, name) =>
  objects.find((one) => one.kind === kind && one.metadata.name === name);

for (const one of objects) {
  let why = '';
  try {
    const models = require(`kubernetes-models/${one.apiVersion}/${one.kind}`);
    new models[one.kind](one).validate();
  } catch (error) {
    why = error.message;
  }
  check(`${one.kind} ${one.metadata.name} by its schema`, why === '', why);
}

const defaults = JSON.parse(
  spawnSync(farhorizon, ['serve', '--print-config'], {encoding: 'utf8'}).stdout);
const keysOf = (object, prefix = '') =>
  Object.entries(object).flatMap(([key, value]) =>
    typeof value === 'object' ? keysOf(value, `${prefix}${key}.`) : [prefix + key]);
const names = keysOf(defaults).map((key) =>
  'FARHORIZON_' + key.replace(/([A-Z])/g, '_$1').replaceAll('.', '_').toUpperCase());

// The program's own word on what a container gives it: no server is asked.
const ofAmazon = ['AWS_ACCESS_KEY_ID', 'AWS_SECRET_ACCESS_KEY'];
function takes(what, words, variables) {
  const unknown =
    Object.keys(variables).filter((name) => !names.includes(name) && !ofAmazon.includes(name));
  check(`${what}: variables`, unknown.length === 0, unknown.join(', '));
  const said = spawnSync(farhorizon, [...words, '--print-config'],
                         {encoding: 'utf8', env: {PATH: process.env.PATH, ...variables}});
  check(`${what}: ${words.join(' ')}`, said.status === 0, said.stderr);
}

const urlOfSecret = 'postgresql://user:word@host/name';
for (const one of objects.filter((object) => object.kind === 'Deployment')) {
  const name = `Deployment ${one.metadata.name}`;
  const {template, selector} = one.spec;
  const matches = (labels) => Object.entries(labels)
    .every(([key, value]) => template.metadata.labels[key] === value);
  check(`${name}: selects its own pods`, matches(selector.matchLabels));
  const budget = called('PodDisruptionBudget', one.metadata.name);
  check(`${name}: has a budget of disruptions`, budget && matches(budget.spec.selector.matchLabels));
  const pod = template.spec;
  const [container] = pod.containers;
  const volumes = pod.volumes.map((volume) => volume.name).sort().join();
  check(`${name}: mounts its volumes`,
        volumes === container.volumeMounts.map((mount) => mount.name).sort().join());
  const claims = pod.volumes.flatMap((volume) => volume.persistentVolumeClaim ?? []);
  check(`${name}: claims that are there`,
        claims.every(({claimName}) => called('PersistentVolumeClaim', claimName)));
  const ports = container.ports.map((port) => port.name);
  for (const probe of ['startupProbe', 'livenessProbe', 'readinessProbe']) {
    check(`${name}: ${probe}`, ports.includes(container[probe]?.httpGet.port));
  }
  const valueOf = ({name: variable, value}) =>
    value ?? (ofAmazon.includes(variable) ? 'of a secret' : urlOfSecret);
  takes(name, container.args,
        Object.fromEntries(container.env.map((entry) => [entry.name, valueOf(entry)])));
  const pause = Number(container.lifecycle.preStop.exec.command[1]);
  const spare = pod.terminationGracePeriodSeconds - pause - defaults.jobs.drainSeconds;
  check(`${name}: ${spare} seconds to end after its drain`, spare >= 10);
}
const service = called('Service', 'farhorizon');
const served = called('Deployment', 'farhorizon-serve').spec.template;
check('Service farhorizon: has pods, at a port of theirs',
      Object.entries(service.spec.selector)
        .every(([key, value]) => served.metadata.labels[key] === value) &&
      served.spec.containers[0].ports.some(({name}) => name === service.spec.ports[0].targetPort));
const scaler = called('HorizontalPodAutoscaler', 'farhorizon-work');
check('HorizontalPodAutoscaler: scales what is there',
      Boolean(called('Deployment', scaler.spec.scaleTargetRef.name)));

const compose = read(path.join(root, 'docker/compose.many-machines.yaml'))[0];
for (const role of ['serve', 'work']) {
  const {environment, command} = compose.services[role];
  const words = command ?? ['serve', '--listen', '0.0.0.0:8080', '--data', '/data'];
  takes(`compose.many-machines.yaml, ${role}`, words,
        {...environment, FARHORIZON_STORE_JOBS: urlOfSecret});
}
console.log(failed === 0 ? 'All hold' : `${failed} failed`);
process.exit(failed === 0 ? 0 : 1);
