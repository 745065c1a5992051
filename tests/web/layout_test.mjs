// SPDX-License-Identifier: Apache-2.0
// Phone and desktop, light and dark: nothing overlaps, nothing is cut off, no number jitters. With
// PENDULINE_SCREENSHOTS=FOLDER it also makes the pictures of docs/.

import assert from 'node:assert';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { drawn, openBrowser, openPage, sleep, until } from './browser.mjs';
import { startProgram } from './program.mjs';

const kLayouts = {
  desktop: { width: 1440, height: 900 },
  phone: { width: 390, height: 844, isMobile: true, hasTouch: true },
  dark: { width: 1440, height: 900, colorScheme: 'dark' },
  narrow: { width: 320, height: 640 },
  tablet: { width: 1000, height: 800 },
};
const kPictures = ['desktop', 'phone', 'dark'];

let program;
before(async () => {
  program = await startProgram();
  if (process.env.PENDULINE_SCREENSHOTS) await sleep(32000); // plots that are full
});
after(() => program?.stop());

/** Pairs of texts, fields and pictures whose boxes overlap, and what is wider than the page or than its own box. */
function troubles() {
  const visible = (element) => element.checkVisibility() && !element.closest('.unseen, .skip, .u-over');
  const boxes = [];
  for (const element of document.querySelectorAll('body *')) {
    if (!visible(element)) continue;
    const texts = [...element.childNodes].filter((node) => node.nodeType === 3 && node.textContent.trim());
    if (/^(CANVAS|BUTTON|INPUT)$/.test(element.tagName)) {
      boxes.push({ element, name: element.tagName, box: element.getBoundingClientRect() });
    } else {
      for (const text of texts) {
        const range = document.createRange();
        range.selectNodeContents(text);
        for (const box of range.getClientRects()) boxes.push({ element, name: text.textContent.trim(), box });
      }
    }
  }
  const found = [];
  for (const [i, a] of boxes.entries()) {
    if (a.box.right > innerWidth + 0.5 || a.box.left < -0.5) found.push(`beyond the page: ${a.name}`);
    for (const b of boxes.slice(i + 1)) {
      const across = Math.min(a.box.right, b.box.right) - Math.max(a.box.left, b.box.left);
      const down = Math.min(a.box.bottom, b.box.bottom) - Math.max(a.box.top, b.box.top);
      // Line boxes of different type sizes on one line share some height; 4 px of both is an overlap.
      if (across > 1 && down > 4 && !a.element.contains(b.element) && !b.element.contains(a.element)) {
        found.push(`${a.name} | ${b.name}`);
      }
    }
  }
  const { scrollWidth } = document.documentElement;
  if (scrollWidth > innerWidth) found.push(`scrolls to ${scrollWidth}`);
  return found;
}

for (const [name, layout] of Object.entries(kLayouts)) {
  test(`nothing overlaps and nothing is cut off: ${name}`, async () => {
    const browser = await openBrowser(layout);
    const { page, complaints } = await openPage(browser, program.url);
    await drawn(page);
    await until('a first ellipse', async () =>
      (await page.textContent('#above-words')).startsWith('Ellipse'), 30000);
    assert.deepEqual(await page.evaluate(troubles), []);
    assert.deepEqual(complaints, []);
    if (process.env.PENDULINE_SCREENSHOTS && kPictures.includes(name)) {
      await page.screenshot({ path: join(process.env.PENDULINE_SCREENSHOTS, `live_${name}.png`), fullPage: true });
    }
    await browser.close();
  });
}

test('dark is dark and light is light, also when the system changes its mind', async () => {
  const browser = await openBrowser({ colorScheme: 'light' });
  const { page } = await openPage(browser, program.url);
  await drawn(page);
  const brightness = () => page.evaluate(() => {
    const [red, green, blue] = getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number);
    return (red + green + blue) / 3;
  });
  const inkOfPlot = () => page.evaluate(() => {
    const canvas = document.querySelector('#above canvas');
    const { width, height } = canvas;
    const pixels = canvas.getContext('2d').getImageData(0, 0, width, height).data;
    let most = -1;
    let least = 256;
    for (let at = 0; at < pixels.length; at += 4) {
      if (pixels[at + 3] === 255) {
        most = Math.max(most, pixels[at]);
        least = Math.min(least, pixels[at]);
      }
    }
    return { most, least };
  });
  assert.ok((await brightness()) > 230);
  assert.ok((await inkOfPlot()).least < 60);
  await page.emulateMedia({ colorScheme: 'dark' });
  await sleep(300);
  assert.ok((await brightness()) < 40);
  assert.ok((await inkOfPlot()).most > 220);
  await browser.close();
});

test('the numbers do not jitter', async () => {
  const browser = await openBrowser();
  const { page } = await openPage(browser, program.url);
  await drawn(page);
  const widths = [];
  for (let i = 0; i < 30; ++i) {
    widths.push(await page.evaluate(() => document.querySelector('#theta1').getBoundingClientRect().width));
    await sleep(100);
  }
  const last = widths.slice(10);
  assert.ok(Math.max(...last) - Math.min(...last) < 0.5, widths.join(' '));
  await browser.close();
});

test('who asked for less motion gets a picture a second', async () => {
  const browser = await openBrowser({ reducedMotion: 'reduce' });
  const { page } = await openPage(browser, program.url);
  await drawn(page);
  const ends = new Set();
  const start_ms = Date.now();
  while (Date.now() - start_ms < 4000) {
    ends.add(await page.evaluate(() => document.querySelector('#angles .plot').dataset.axes));
    await sleep(40);
  }
  assert.ok(ends.size >= 3 && ends.size <= 6, `${ends.size} pictures in 4 s`);
  await browser.close();
});
