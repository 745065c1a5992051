// SPDX-License-Identifier: Apache-2.0
// The page beside a running program: what moves, what comes back, and that nobody is in another's way.

import assert from 'node:assert';
import { connect } from 'node:net';
import { test } from 'node:test';
import { axesOf, drawn, openPage, sleep, until } from './browser.mjs';
import { liveRun } from './live_run.mjs';
import { followLive, startProgram } from './program.mjs';

const kLargestPage_bytes = 150 * 1024;
const kFirstPlot_ms = 5000; // the aim is 1 s, on a machine that does nothing else

const run = liveRun();

const connection = (page) => page.textContent('#connection');
const pictureOf = (page, selector) => page.evaluate((found) => document.querySelector(found).toDataURL(), selector);

test('the first plot is there soon after opening', async (t) => {
  const page = await run.browser.newPage();
  const start_ms = Date.now();
  await page.goto(run.program.url);
  await drawn(page);
  const taken_ms = Date.now() - start_ms;
  t.diagnostic(`first plot after ${taken_ms} ms`);
  assert.ok(taken_ms < kFirstPlot_ms, `${taken_ms} ms`);
  await page.close();
});

test('the page weighs at most 150 KB', async (t) => {
  let bytes = 0;
  for (const path of ['', 'page.js', 'page.css']) {
    const answer = await fetch(new URL(path, run.program.url));
    assert.equal(answer.status, 200);
    bytes += (await answer.arrayBuffer()).byteLength;
  }
  t.diagnostic(`${bytes} bytes`);
  assert.ok(bytes <= kLargestPage_bytes, `${bytes} bytes`);
});

test('every picture moves, with no complaint in the console', async () => {
  const { page, complaints } = await openPage(run.browser, run.program.url);
  await drawn(page);
  const canvases = ['#angles canvas', '#gaps canvas', '#signals canvas', '#above canvas', '#space canvas'];
  await page.setViewportSize({ width: 1440, height: 2000 }); // what is out of sight is not drawn
  await sleep(500);
  const before = await Promise.all(canvases.map((canvas) => pictureOf(page, canvas)));
  const { t_s: [, before_s] } = await axesOf(page, 'angles');
  await sleep(1000);
  const { t_s: [, after_s] } = await axesOf(page, 'angles');
  assert.ok(after_s > before_s + 0.5, `${before_s} s, then ${after_s} s`);
  for (const [i, canvas] of canvases.entries()) {
    assert.notEqual(await pictureOf(page, canvas), before[i], canvas);
  }
  assert.equal(await connection(page), 'Live');
  assert.deepEqual(complaints, []);
  await page.close();
});

test('two viewers see the same', async () => {
  const pages = await Promise.all([openPage(run.browser, run.program.url), openPage(run.browser, run.program.url)]);
  for (const { page } of pages) await drawn(page);
  await sleep(500);
  const [first, second] = await Promise.all(pages.map(({ page }) => axesOf(page, 'gaps').catch(() => null)));
  const ends = await Promise.all(pages.map(({ page }) => axesOf(page, 'angles')));
  assert.deepEqual(first?.value, second?.value);
  assert.ok(Math.abs(ends[0].t_s[1] - ends[1].t_s[1]) < 1, JSON.stringify(ends));
  for (const { page } of pages) await page.close();
});

test('a viewer who does not read disturbs neither sampling nor the others', async () => {
  const stalled = Array.from({ length: 5 }, () => {
    const socket = connect(run.program.port, '127.0.0.1');
    socket.on('error', () => {});
    socket.write(`GET /live HTTP/1.1\r\nHost: 127.0.0.1:${run.program.port}\r\n\r\n`);
    socket.pause();
    return socket;
  });
  const { page } = await openPage(run.browser, run.program.url);
  await drawn(page);
  const live = followLive(run.program.url);
  await until('a state', () => live.events.state.length > 0);
  const before = live.events.state.at(-1);
  const { t_s: [, before_s] } = await axesOf(page, 'angles');
  await sleep(4000);
  const now = live.events.state.at(-1);
  const { t_s: [, after_s] } = await axesOf(page, 'angles');
  const samples = now.samples - before.samples;
  assert.ok(samples >= 50 && samples <= 110, `${samples} samples in about 4 s at 20 Hz`);
  assert.equal(now.lost, before.lost);
  assert.ok(after_s > before_s + 2.5, `${before_s} s, then ${after_s} s`);
  live.stop();
  stalled.forEach((socket) => socket.destroy());
  await page.close();
});

test('the page says that the program is away, and goes on when it is back', async () => {
  const first = await startProgram();
  const { page } = await openPage(run.browser, first.url);
  await drawn(page);
  await until('more than 3 s of a first run', async () => (await axesOf(page, 'angles')).t_s[1] > 3);
  await first.stop();
  await until('the words', async () => (await connection(page)) === 'The program does not answer; trying again');
  assert.ok(await page.isDisabled('#record-button'));
  const second = await startProgram({ port: first.port });
  await until('Live', async () => (await connection(page)) === 'Live');
  await until('the second run alone', async () => (await axesOf(page, 'angles')).t_s[1] < 3);
  const { t_s: [, before_s] } = await axesOf(page, 'angles');
  await until('new rows', async () => (await axesOf(page, 'angles')).t_s[1] > before_s + 0.5);
  assert.ok(await page.isEnabled('#record-button'));
  await page.close();
  await second.stop();
});

test('a stream that was refused is asked for again', async () => {
  const page = await run.browser.newPage();
  let refusals = 0;
  await page.route('**/live', (route) => {
    if (++refusals <= 2) return route.fulfill({ status: 503, body: 'full' });
    return route.continue();
  });
  await page.goto(run.program.url);
  await until('Live', async () => (await connection(page)) === 'Live');
  assert.equal(refusals, 3);
  await page.close();
});

test('a tab that slept shows the latest when it wakes up', async () => {
  const { page, complaints } = await openPage(run.browser, run.program.url);
  await drawn(page);
  const { t_s: [, asleep_s] } = await axesOf(page, 'angles');
  const devtools = await run.browser.newCDPSession(page);
  await devtools.send('Page.setWebLifecycleState', { state: 'frozen' });
  await sleep(5000);
  await devtools.send('Page.setWebLifecycleState', { state: 'active' });
  await until('the latest rows', async () => (await axesOf(page, 'angles')).t_s[1] > asleep_s + 4.5, 5000);
  assert.equal(await connection(page), 'Live');
  assert.deepEqual(complaints, []);
  await page.close();
});
