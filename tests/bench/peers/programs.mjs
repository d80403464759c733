// Runs the programs of the contest, and says what is going on.
import {spawn} from 'node:child_process';
import fs from 'node:fs';

export function say(message) {
  process.stderr.write(`peers: ${message}\n`);
}

/** The most memory that a running process has had, MiB; undefined once it is gone. */
function peakOf(pid) {
  try {
    const [, kib] = /VmHWM:\s*(\d+)/.exec(fs.readFileSync(`/proc/${pid}/status`, 'utf8')) ?? [];
    return kib && kib / 1024;
  } catch {
    return undefined;
  }
}

/**
 * {status, stdout, stderr, stopped, peak}: `stopped` where the limit of seconds ended it, `peak`
 * its memory in MiB, but for what it took in its last twentieth of a second.
 */
export function runProgram(command, {limit} = {}) {
  return new Promise((resolve, reject) => {
    const child = spawn(command[0], command.slice(1), {stdio: ['ignore', 'pipe', 'pipe']});
    let stdout = '', stderr = '', stopped = false, peak = 0;
    const clock = limit && setTimeout(() => { stopped = true; child.kill(); }, 1000 * limit);
    const look = setInterval(() => peak = peakOf(child.pid) ?? peak, 50);
    child.stdout.setEncoding('utf8').on('data', data => stdout += data);
    child.stderr.setEncoding('utf8').on('data', data => stderr += data);
    child.on('error', reject);
    child.on('close', status => {
      clearTimeout(clock);
      clearInterval(look);
      resolve({status, stdout, stderr, stopped, peak});
    });
  });
}

/** What a program said of its failure: node's own errors are lines before the last. */
export function lastWords({stderr, status}) {
  const said = stderr.trim().split('\n');
  return said.find(line => /^\w*Error\b/.test(line)) || said.at(-1) || `exit status ${status}`;
}

/** Runs what has to succeed. */
export async function must(command, options) {
  const done = await runProgram(command, options);
  if (done.status === 0) return done.stdout;
  throw new Error(lastWords(done));
}

export const readJson = (file, otherwise) =>
  fs.existsSync(file) || otherwise === undefined ? JSON.parse(fs.readFileSync(file)) : otherwise;
