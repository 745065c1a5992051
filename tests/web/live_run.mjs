// SPDX-License-Identifier: Apache-2.0
// A running program and a browser to look at it, for all tests of a file.

import { after, before } from 'node:test';
import { openBrowser } from './browser.mjs';
import { startProgram } from './program.mjs';

/** What it returns has `program` and `browser` while the tests run. `options`: of startProgram. */
export function liveRun(options) {
  const run = {};
  before(async () => {
    run.program = await startProgram(options);
    run.browser = await openBrowser();
  });
  after(async () => {
    await run.browser?.close();
    await run.program?.stop();
  });
  return run;
}
