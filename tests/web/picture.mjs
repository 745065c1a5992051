// SPDX-License-Identifier: Apache-2.0
// Plots as pixels, with what their axes span.

import { PNG } from 'pngjs';

/** Of 255, a channel: anti-aliasing mixes a thin curve with what is behind it. */
export const kLikeness = 60;

/** What `section` of `page` shows now: its canvas as a picture, its plotting area in the canvas's pixels, its axes. */
export async function shown(page, section) {
  const found = await page.evaluate((id) => {
    const host = document.querySelector(`#${id} .plot`);
    const canvas = host.querySelector('canvas');
    const all = canvas.getBoundingClientRect();
    const area = host.querySelector('.u-over').getBoundingClientRect();
    const scale = canvas.width / all.width;
    return {
      png: canvas.toDataURL('image/png'), axes: JSON.parse(host.dataset.axes),
      left: (area.left - all.left) * scale, top: (area.top - all.top) * scale,
      width: area.width * scale, height: area.height * scale,
    };
  }, section);
  return { ...found, picture: PNG.sync.read(Buffer.from(found.png.split(',')[1], 'base64')) };
}

/** How many pixels of `picture` are like `wanted`. */
export function pixelsLike({ data }, wanted) {
  let found = 0;
  for (let at = 0; at < data.length; at += 4) {
    found += data[at + 3] > 150 && wanted.every((value, i) => Math.abs(value - data[at + i]) <= kLikeness) ? 1 : 0;
  }
  return found;
}

/** The page's colour of that name as [red, green, blue]. */
export function colour(page, name) {
  return page.evaluate((property) => {
    const text = getComputedStyle(document.documentElement).getPropertyValue(property).trim();
    return [1, 3, 5].map((at) => Number.parseInt(text.slice(at, at + 2), 16));
  }, name);
}
