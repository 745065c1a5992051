// SPDX-License-Identifier: Apache-2.0
// Debian's chromium without a window and without the internet, and pages in it that keep what went wrong.

import { chromium } from 'playwright-core';

const kChromium = process.env.CHROMIUM ?? '/usr/bin/chromium';
const kArguments = ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync'];

/** A browser of `width` by `height` CSS pixels; `options` as of playwright (colorScheme, reducedMotion, ...). */
export async function openBrowser({ width = 1440, height = 900, ...options } = {}) {
  const kNewProfile = ''; // playwright makes one and removes it
  return chromium.launchPersistentContext(kNewProfile,
    { executablePath: kChromium, args: kArguments, viewport: { width, height }, ...options });
}

/** A page of `browser` at `url`; `complaints` fills with every console error or warning and exception. */
export async function openPage(browser, url) {
  const page = await browser.newPage();
  const complaints = [];
  page.on('console', (message) => {
    if (message.type() === 'error' || message.type() === 'warning') complaints.push(message.text());
  });
  page.on('pageerror', (error) => complaints.push(String(error.stack)));
  await page.goto(url);
  return { page, complaints };
}

/** Waits until the angles have been drawn. */
export function drawn(page) {
  return page.waitForFunction(() => document.querySelector('#angles .plot').dataset.axes !== undefined);
}

/** What the axes of the plot in `section` span: { t_s: [from, to], value: [least, greatest] }. */
export function axesOf(page, section) {
  return page.evaluate((id) => JSON.parse(document.querySelector(`#${id} .plot`).dataset.axes), section);
}

export const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

/** Waits until `condition()` holds; fails naming `what` after `within_ms`. */
export async function until(what, condition, within_ms = 15000) {
  const end_ms = Date.now() + within_ms;
  while (!(await condition())) {
    if (Date.now() > end_ms) throw new Error(`not within ${within_ms} ms: ${what}`);
    await sleep(50);
  }
}
