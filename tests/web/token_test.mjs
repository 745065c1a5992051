// SPDX-License-Identifier: Apache-2.0
// The page of a run that others can watch: they see all, and change nothing without the token.

import assert from 'node:assert';
import { test } from 'node:test';
import { drawn, openPage, until } from './browser.mjs';
import { liveRun } from './live_run.mjs';

const run = liveRun({ address: '0.0.0.0' });

const words = (page) => page.textContent('#actions-words');

test('without the token the page shows the run and says why its buttons are off', async () => {
  const { page, complaints } = await openPage(run.browser, run.program.url);
  await drawn(page);
  assert.equal(await words(page),
    'To record and mark, open the address that the program printed; it ends in a token.');
  for (const id of ['record-button', 'mark-text', 'mark-button']) {
    assert.ok(await page.isDisabled(`#${id}`), id);
  }
  assert.deepEqual(complaints, []);
  await page.close();
});

test('a wrong token is refused in the words of the program', async () => {
  const { page } = await openPage(run.browser, `${run.program.url}#token=${'0'.repeat(32)}`);
  await drawn(page);
  await page.click('#record-button');
  await until('the words', async () => /token is missing or wrong/.test(await words(page)));
  assert.equal(await page.textContent('#record-button'), 'Start recording');
  await page.close();
});

test('the page shows the run where it may store nothing, too, and its token works', async () => {
  const page = await run.browser.newPage();
  await page.addInitScript(() => Object.defineProperty(window, 'sessionStorage', {
    get() { throw new DOMException('denied', 'SecurityError'); },
  }));
  await page.goto(`${run.program.url}${run.program.token}`);
  await drawn(page);
  assert.equal(page.url(), run.program.url);
  assert.ok(await page.isEnabled('#mark-button'));
  await page.close();
});

test('with the token marks are set, it leaves the address bar, and a reload keeps it', async () => {
  assert.match(run.program.token, /^#token=[0-9a-f]{32}$/);
  const { page } = await openPage(run.browser, `${run.program.url}${run.program.token}`);
  await drawn(page);
  assert.equal(page.url(), run.program.url);
  await page.reload();
  await drawn(page);
  await page.fill('#mark-text', 'kept');
  await page.click('#mark-button');
  await until('the note', async () => (await page.textContent('#note-list')).includes('kept'));
  assert.equal(await page.inputValue('#mark-text'), '');
  await page.close();
});
