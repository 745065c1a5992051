// SPDX-License-Identifier: Apache-2.0
// The drawn curves are the data: the pixels where each datum of /live must be, and where none must be.

import assert from 'node:assert';
import { after, before, test } from 'node:test';
import { PNG } from 'pngjs';
import { drawn, openBrowser, openPage, sleep } from './browser.mjs';
import { colour, kLikeness, shown } from './picture.mjs';
import { followLive, rowsOf, startProgram } from './program.mjs';

const kRows = 60;
const kNear_px = 2;
const kFar_px = 14;

let program;
let browser;
let page;
let live;
before(async () => {
  program = await startProgram();
  live = followLive(program.url);
  browser = await openBrowser({ height: 2000 });
  ({ page } = await openPage(browser, program.url));
  await drawn(page);
  await sleep(8000);
});
after(async () => {
  live?.stop();
  await browser?.close();
  await program?.stop();
});

/** Whether a pixel like `wanted` is within `near` of (x, y). */
function has({ picture }, wanted, x, y, near) {
  for (let row = Math.round(y) - near; row <= Math.round(y) + near; ++row) {
    for (let column = Math.round(x) - near; column <= Math.round(x) + near; ++column) {
      const at = 4 * (row * picture.width + column);
      const pixel = picture.data.subarray(at, at + 4);
      if (pixel[3] > 150 && wanted.every((value, i) => Math.abs(value - pixel[i]) <= kLikeness)) return true;
    }
  }
  return false;
}

/** Counts of rows whose datum is drawn, and of places far above and below every datum that are not of the colour. */
function compare(view, rows, wanted) {
  const { left, top, width, height, axes } = view;
  const [from_s, to_s] = axes.t_s;
  const [least, greatest] = axes.value;
  const place = ([t_s, value]) =>
    [left + (width * (t_s - from_s)) / (to_s - from_s), top + (height * (greatest - value)) / (greatest - least)];
  const visible = rows.filter(([t_s]) => t_s > from_s + 0.5 && t_s < to_s - 0.5).slice(-kRows);
  let there = 0;
  let clear = 0;
  let probed = 0;
  for (const row of visible) {
    const [x, y] = place(row);
    there += has(view, wanted, x, y, kNear_px) ? 1 : 0;
    // What else is drawn in these columns of pixels.
    const others = rows.map(place).filter(([otherX]) => Math.abs(otherX - x) < 12).map(([, otherY]) => otherY);
    for (const beside of [Math.min(...others) - kFar_px, Math.max(...others) + kFar_px]) {
      if (beside > top + 4 && beside < top + height - 4) {
        ++probed;
        clear += has(view, wanted, x, beside, kNear_px) ? 0 : 1;
      }
    }
  }
  return { rows: visible.length, there, probed, clear };
}

for (const [section, column, property, scale] of [
  ['angles', 'theta1_rad', '--first', 180 / Math.PI], ['angles', 'theta2_rad', '--second', 180 / Math.PI]]) {
  test(`the pixels of ${section} are ${column}`, async () => {
    const view = await shown(page, section);
    await sleep(300); // what the page had, this stream has by now
    const rows = rowsOf(live.events.points, column).map(([t_s, value]) => [t_s, value * scale]);
    const found = compare(view, rows, await colour(page, property));
    assert.equal(found.rows, kRows);
    // Where the other curve crosses, it hides this one.
    assert.ok(found.there >= 0.9 * found.rows, JSON.stringify(found));
    assert.ok(found.probed > kRows / 2 && found.clear === found.probed, JSON.stringify(found));
  });
}

for (const [section, key, scale] of [['gaps', 'gap_m', 1000], ['signals', 'signal_v', 1]]) {
  test(`the pixels of ${section} are ${key}`, async () => {
    const view = await shown(page, section);
    await sleep(300);
    for (const [i, property] of ['--first', '--second'].entries()) {
      const rows = live.events.points.flatMap((event) => event.t_s.map((t_s, at) => [t_s, event[key][i][at]]))
        .filter(([, value]) => value !== null).map(([t_s, value]) => [t_s, value * scale]);
      const found = compare(view, rows, await colour(page, property));
      assert.equal(found.rows, kRows);
      assert.ok(found.there >= 0.85 * found.rows, `sensor ${i}: ${JSON.stringify(found)}`);
    }
  });
}

test('the trail from above goes where the mass has been', async () => {
  const { png, reach, ratio } = await page.evaluate(() => {
    const canvas = document.querySelector('#above canvas');
    return { png: canvas.toDataURL(), reach: Number(canvas.dataset.reach), ratio: canvas.width / canvas.clientWidth };
  });
  await sleep(300);
  const picture = PNG.sync.read(Buffer.from(png.split(',')[1], 'base64'));
  const ink = await colour(page, '--ink');
  const margin = 26 * ratio;
  const scale = (Math.min(picture.width, picture.height) / 2 - margin) / reach;
  const place = (x_m, y_m) => [picture.width / 2 + 1000 * x_m * scale, picture.height / 2 - 1000 * y_m * scale];
  const events = live.events.points;
  const rows = events.flatMap((event) => event.t_s.map((_, i) => [event.x_m[i], event.y_m[i]]))
    .filter(([x_m]) => x_m !== null).slice(-40, -8);
  const there = rows.filter(([x_m, y_m]) => has({ picture }, ink, ...place(x_m, y_m), kNear_px)).length;
  assert.ok(there >= 0.9 * rows.length, `${there} of ${rows.length}`);
  assert.ok(!has({ picture }, ink, picture.width / 2 + 0.97 * reach * scale, margin / 2, kNear_px));
});
