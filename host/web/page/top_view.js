// SPDX-License-Identifier: Apache-2.0
// The mass's path from above: rings of millimetres, a fading trail, the fitted ellipse, where the mass is.
import { roundStep, SteadyReach } from './reach.js';
import { addToTrail, cleanSheet, fadingTrail } from './sheet.js';
import { theme } from './theme.js';
import { ticks } from './words.js';

const kMargin_px = 26;

export class TopView {
  constructor(section) {
    this.canvas = section.querySelector('canvas');
    this.steady = new SteadyReach(2);
  }

  /// Rows [from, to) of `series` as the trail, the mass at row `now` (-1: nowhere), `ellipse` as `state` has it.
  draw(series, from, to, now, ellipse) {
    const { context, width, height } = cleanSheet(this.canvas);
    const { x, y } = series.columns;
    let farthest = NaN;
    for (let row = from; row < to; ++row) {
      const distance = Math.hypot(x[row], y[row]);
      farthest = distance <= farthest || Number.isNaN(distance) ? farthest : distance;
    }
    if (ellipse) {
      farthest = Math.max(farthest || 0, 1000 * (Math.hypot(ellipse.x_m, ellipse.y_m) + ellipse.a_m));
    }
    const reach = this.steady.fit(farthest);
    const scale = (Math.min(width, height) / 2 - kMargin_px) / reach;
    const place = (x_mm, y_mm) => ({ x: width / 2 + x_mm * scale, y: height / 2 - y_mm * scale });
    this.drawRings(context, place, scale, reach);
    const points = [];
    for (let row = from; row < to; ++row) {
      addToTrail(points, Number.isNaN(x[row]) ? null : place(x[row], y[row]));
    }
    fadingTrail(context, points, theme.ink, 2);
    this.drawLabels(context, place, reach);
    if (ellipse) {
      this.drawEllipse(context, place, scale, ellipse);
    }
    if (now >= 0 && !Number.isNaN(x[now])) {
      const mass = place(x[now], y[now]);
      context.fillStyle = theme.ink;
      context.strokeStyle = theme.paper;
      context.lineWidth = 2;
      context.beginPath();
      context.arc(mass.x, mass.y, 7, 0, 2 * Math.PI);
      context.fill();
      context.stroke();
    }
    // What the picture spans, for whoever reads it by program.
    this.canvas.dataset.reach = reach;
  }

  drawRings(context, place, scale, reach) {
    const centre = place(0, 0);
    context.lineWidth = 1;
    context.strokeStyle = theme.grid;
    context.beginPath();
    context.moveTo(centre.x - reach * scale, centre.y);
    context.lineTo(centre.x + reach * scale, centre.y);
    context.moveTo(centre.x, centre.y - reach * scale);
    context.lineTo(centre.x, centre.y + reach * scale);
    for (const radius of ringRadii(reach)) {
      context.moveTo(centre.x + radius * scale, centre.y);
      context.arc(centre.x, centre.y, radius * scale, 0, 2 * Math.PI);
    }
    context.stroke();
  }

  /// Texts with a rim of paper, so that lines do not strike them out.
  drawLabels(context, place, reach) {
    const radii = ringRadii(reach);
    const labels = ticks(radii).map((text, i) =>
      [`${text} mm`, place(radii[i] * Math.SQRT1_2, -radii[i] * Math.SQRT1_2), 0, 0]);
    labels.push(['x', place(reach, 0), 12, 0], ['y', place(0, reach), 0, -14]);
    context.font = `12px ${theme.font}`;
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    context.strokeStyle = theme.paper;
    context.fillStyle = theme.quiet;
    context.lineWidth = 3;
    for (const [text, { x, y }, right, down] of labels) {
      context.strokeText(text, x + right, y + down);
      context.fillText(text, x + right, y + down);
    }
  }

  drawEllipse(context, place, scale, { a_m, b_m, x_m, y_m, orientation_rad }) {
    const centre = place(1000 * x_m, 1000 * y_m);
    context.strokeStyle = theme.ellipse;
    context.lineWidth = 1.5;
    context.setLineDash([6, 5]);
    context.beginPath();
    context.ellipse(centre.x, centre.y, 1000 * a_m * scale, 1000 * b_m * scale, -orientation_rad, 0, 2 * Math.PI);
    context.stroke();
    context.setLineDash([]);
  }
}

function ringRadii(reach) {
  const step = roundStep(reach);
  return Array.from({ length: Math.floor(reach / step + 1e-9) }, (_, i) => (i + 1) * step);
}
