// The real mms: a small run of a simulated warehouse, and the server for its results.
import { execFileSync, spawn } from 'node:child_process';
import { createServer } from 'node:net';
import { join } from 'node:path';

const kProgram = process.env.MMS_PROGRAM;

/** Simulates a recording and runs on it; returns the folder of the results. */
export function makeRun(folder) {
  if (!kProgram) throw new Error('MMS_PROGRAM does not say where mms is');
  const [recording, results] = [join(folder, 'recording'), join(folder, 'run')];
  const mms = (...words) => execFileSync(kProgram, words, { stdio: ['ignore', 'ignore', 'inherit'] });
  mms('simulate', 'stop_and_go', '-o', recording, '--frames', '24', '--blur', '1');
  mms('run', recording, '--segmenter', 'masks', '-o', results);
  return results;
}

/** A free port. */
export function freePort() {
  return new Promise((resolve, reject) => {
    const server = createServer();
    server.on('error', reject);
    server.listen(0, '127.0.0.1', () => {
      const { port } = server.address();
      server.close(() => resolve(port));
    });
  });
}

/** mms view; `stop` waits for its end. */
export class Server {
  constructor(run, port) {
    this.address = `http://127.0.0.1:${port}/`;
    this.arguments = ['view', run, '--port', String(port)];
  }

  async start() {
    this.process = spawn(kProgram, this.arguments, { stdio: ['ignore', 'ignore', 'inherit'] });
    this.gone = new Promise((resolve) => this.process.on('exit', resolve));
    for (let waited = 0; waited < 20_000; waited += 100) {
      if (this.process.exitCode !== null) throw new Error(`mms ${this.arguments.join(' ')} ended`);
      const answer = await fetch(this.address).catch(() => null);
      if (answer?.ok) return;
      await new Promise((resolve) => setTimeout(resolve, 100));
    }
    throw new Error(`no answer from ${this.address}`);
  }

  async stop() {
    this.process?.kill('SIGINT');
    await this.gone;
  }
}
