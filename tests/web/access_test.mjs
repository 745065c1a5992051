// SPDX-License-Identifier: Apache-2.0
// The page for those who use the keyboard alone, and for those who hear it: axe-core, and every action by keys.

import assert from 'node:assert';
import { readdirSync, readFileSync } from 'node:fs';
import { test } from 'node:test';
import { violations } from './axe.mjs';
import { drawn, openPage, sleep, until } from './browser.mjs';
import { liveRun } from './live_run.mjs';

const kMostTabs = 30;

const run = liveRun();

for (const colorScheme of ['light', 'dark']) {
  test(`axe-core finds nothing to say against the ${colorScheme} page`, async () => {
    const { page } = await openPage(run.browser, run.program.url);
    await page.emulateMedia({ colorScheme });
    await drawn(page);
    await sleep(1500);
    assert.deepEqual(await violations(page), []);
    await page.close();
  });
}

/** Presses Tab until the element `id` has the focus. */
async function tabTo(page, id) {
  for (let i = 0; i < kMostTabs; ++i) {
    await page.keyboard.press('Tab');
    const focused = await page.evaluate(() => {
      const { id: own, parentElement } = document.activeElement;
      return { id: own || parentElement?.id, outline: getComputedStyle(document.activeElement).outlineStyle };
    });
    if (focused.id === id) {
      assert.notEqual(focused.outline, 'none', `${id} has the focus and no ring`);
      return;
    }
  }
  assert.fail(`no way to ${id} in ${kMostTabs} tabs`);
}

test('keys alone start a recording, set a mark and stop it', async () => {
  const { page, complaints } = await openPage(run.browser, run.program.url);
  await drawn(page);
  await until('a button', () => page.isEnabled('#record-button'));
  await tabTo(page, 'record-button');
  await page.keyboard.press('Enter');
  await until('a recording', async () => (await page.textContent('#record-button')) === 'Stop recording');
  await until('the words', async () => (await page.textContent('#record-words')).startsWith('Recording into '));
  assert.equal(await page.evaluate(() => document.activeElement.id), 'record-button');
  await until('the sentence', async () => /^Recording into .*\.csv\.$/.test(await page.textContent('#announcement')));
  await tabTo(page, 'mark-text');
  await page.keyboard.type('a gust <b>of</b> wind');
  await page.keyboard.press('Enter');
  await until('the note', async () => (await page.textContent('#note-list')).includes('a gust <b>of</b> wind'));
  await page.focus('#record-button');
  await page.keyboard.press('Space');
  await until('the end', async () => (await page.textContent('#record-button')) === 'Start recording');
  await until('a download', () => page.isVisible('#download'));
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#download')]);
  const text = readFileSync(await download.path(), 'utf8');
  assert.match(text, /^# penduline_recording = 1$/m);
  assert.match(text, /a gust <b>of<\/b> wind/);
  assert.ok(readdirSync(run.program.folder).some((name) => name.endsWith('.csv')));
  assert.deepEqual(complaints, []);
  await page.close();
});

test('keys alone turn the view in space, and turn it back', async () => {
  const { page } = await openPage(run.browser, run.program.url);
  await drawn(page);
  const seenFrom = async () => /seen from (.*)\.$/.exec(await page.textContent('#space-words'))?.[1];
  await until('words', async () => (await seenFrom()) !== undefined);
  await tabTo(page, 'space');
  const home = await seenFrom();
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('ArrowUp');
  const turned = await seenFrom();
  assert.notEqual(turned, home);
  await page.keyboard.press('Home');
  assert.equal(await seenFrom(), home);
  await page.close();
});

test('with reduced motion the view in space turns with each key, not once a second', async () => {
  const page = await run.browser.newPage();
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.goto(run.program.url);
  await drawn(page);
  await page.locator('#space canvas').scrollIntoViewIfNeeded();
  await tabTo(page, 'space');
  const picture = () => page.evaluate(() => document.querySelector('#space canvas').toDataURL());
  const begin_ms = Date.now();
  let latest = await picture();
  for (let i = 0; i < 5; ++i) {
    await page.keyboard.press('ArrowLeft');
    const before = latest;
    await until('it turns', async () => (latest = await picture()) !== before);
  }
  assert.ok(Date.now() - begin_ms < 2500, `${Date.now() - begin_ms} ms for 5 turns`);
  await page.close();
});

test('what is said twice is heard twice', async () => {
  const { page } = await openPage(run.browser, run.program.url);
  await drawn(page);
  await until('a button', () => page.isEnabled('#mark-button'));
  await page.evaluate(() => {
    window.said = [];
    const element = document.getElementById('announcement');
    new MutationObserver(() => window.said.push(element.textContent)).observe(element,
      { childList: true, characterData: true, subtree: true });
  });
  for (const times of [1, 2]) {
    await page.click('#mark-button');
    await until('the words', () => page.evaluate((wanted) =>
      window.said.filter((text) => text === 'Marked: mark.').length === wanted, times), 5000);
  }
  await page.close();
});

test('the pointer turns the view in space', async () => {
  const { page } = await openPage(run.browser, run.program.url);
  await drawn(page);
  await until('words', async () => (await page.textContent('#space-words')).includes('seen from'));
  const view = page.locator('#space canvas');
  await view.scrollIntoViewIfNeeded();
  const { x, y } = await view.boundingBox();
  const home = /seen from (.*)\.$/.exec(await page.textContent('#space-words'))[1];
  await page.mouse.move(x + 150, y + 150);
  await page.mouse.down();
  await page.mouse.move(x + 220, y + 170, { steps: 5 });
  await page.mouse.up();
  assert.notEqual(/seen from (.*)\.$/.exec(await page.textContent('#space-words'))[1], home);
  await page.close();
});

test('what is said aloud changes with the state only, not with each second', async () => {
  const { page } = await openPage(run.browser, run.program.url);
  await drawn(page);
  await sleep(500);
  const said = await page.evaluate(() => new Promise((resolve) => {
    let changes = 0;
    const observer = new MutationObserver(() => ++changes);
    for (const live of document.querySelectorAll('[role=status], [role=alert], [aria-live]')) {
      observer.observe(live, { childList: true, characterData: true, subtree: true });
    }
    setTimeout(() => resolve(changes), 3500);
  }));
  assert.equal(said, 0);
  await page.close();
});
