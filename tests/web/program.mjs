// SPDX-License-Identifier: Apache-2.0
// `penduline run sim: --web`: a running program for a browser to look at, and its stream of events.

import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import http from 'node:http';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';

export const kRig = fileURLToPath(new URL('../../docs/rigs/tcrt5000.toml', import.meta.url));
const kStart_ms = 20000;

// A swing that the rig's sensors see well, all the way round.
const kSwing = ['--estimator', 'ekf', '--theta-deg', '6', '--phi-deg', '30', '--psi', '3'];

/**
 * Starts the program at `address` and `port` (0: any), in a folder of its own, and waits until it has printed the
 * page's address; `more` are options of the program. `url` is that of this machine, `token` what stands behind it.
 */
export async function startProgram({ address = '127.0.0.1', port = 0, more = [] } = {}) {
  const folder = mkdtempSync(join(tmpdir(), 'penduline-web-'));
  const program = spawn(process.env.PENDULINE,
    ['run', 'sim:', '--rig', kRig, '--web', `${address}:${port}`, ...kSwing, ...more],
    { cwd: folder, stdio: ['ignore', 'ignore', 'pipe'] });
  const ended = new Promise((resolve) => program.once('exit', resolve));
  const printed = await new Promise((resolve, reject) => {
    const said = [];
    const late = setTimeout(() => reject(new Error(`no address after ${kStart_ms} ms: ${said.join('\n')}`)), kStart_ms);
    createInterface({ input: program.stderr }).on('line', (line) => {
      said.push(line);
      const found = /http:\/\/\S+/.exec(line);
      if (found) {
        clearTimeout(late);
        resolve(new URL(found[0]));
      }
    });
    program.once('exit', () => reject(new Error(`ended: ${said.join('\n')}`)));
  });
  return {
    url: `http://127.0.0.1:${printed.port}/`,
    port: Number(printed.port),
    token: printed.hash,
    folder,
    pid: program.pid,
    signal: (name) => program.kill(name),
    stop: async () => {
      program.kill('SIGTERM');
      program.kill('SIGCONT');
      await ended;
      rmSync(folder, { recursive: true });
    },
  };
}

/** Follows `/live` of `url`: `events[name]` are the data of all events of that name, `stop()` ends it. */
export function followLive(url) {
  const events = { session: [], points: [], state: [], note: [] };
  let rest = '';
  const request = http.get(new URL('live', url), (response) => {
    response.setEncoding('utf8');
    response.on('error', () => {});
    response.on('data', (text) => {
      const blocks = (rest + text).split('\n\n');
      rest = blocks.pop();
      for (const block of blocks) {
        const name = /^event: ?(.*)$/m.exec(block)?.[1];
        if (name) events[name].push(JSON.parse(/^data: ?(.*)$/m.exec(block)[1]));
      }
    });
  });
  request.on('error', () => {});
  return { events, stop: () => request.destroy() };
}

/** The rows of all `points` events as [t_s, value] of `column` (theta1_rad), no answer left out. */
export function rowsOf(points, column) {
  return points.flatMap((event) => event.t_s.map((t_s, i) => [t_s, event[column][i]]))
    .filter(([, value]) => value !== null);
}
