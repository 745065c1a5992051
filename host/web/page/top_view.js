// SPDX-License-Identifier: Apache-2.0
// The mass's path from above: rings of millimetres, a fading trail, the fitted ellipse, where the mass is.
import { roundStep, SteadyReach } from './reach.js';
import { cleanSheet, fadingTrail } from './sheet.js';
import { theme } from './theme.js';
import { tick } from './words.js';

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
    const reach = this.steady.fit(farthest);
    const scale = (Math.min(width, height) / 2 - kMargin_px) / reach;
    const place = (x_mm, y_mm) => ({ x: width / 2 + x_mm * scale, y: height / 2 - y_mm * scale });
    this.drawRings(context, place, scale, reach);
    if (ellipse) {
      this.drawEllipse(context, place, scale, ellipse);
    }
    const points = [];
    for (let row = from; row < to; ++row) {
      points.push(Number.isNaN(x[row]) ? null : place(x[row], y[row]));
    }
    fadingTrail(context, points, theme.first, 2);
    if (now >= 0 && !Number.isNaN(x[now])) {
      const mass = place(x[now], y[now]);
      context.fillStyle = theme.first;
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
    const step = roundStep(reach);
    context.lineWidth = 1;
    context.strokeStyle = theme.grid;
    context.fillStyle = theme.quiet;
    context.font = `12px ${theme.font}`;
    context.beginPath();
    context.moveTo(centre.x - reach * scale, centre.y);
    context.lineTo(centre.x + reach * scale, centre.y);
    context.moveTo(centre.x, centre.y - reach * scale);
    context.lineTo(centre.x, centre.y + reach * scale);
    for (let radius = step; radius <= reach * (1 + 1e-9); radius += step) {
      context.moveTo(centre.x + radius * scale, centre.y);
      context.arc(centre.x, centre.y, radius * scale, 0, 2 * Math.PI);
    }
    context.stroke();
    context.textBaseline = 'middle';
    context.textAlign = 'left';
    context.fillText('x', centre.x + reach * scale + 8, centre.y);
    context.textAlign = 'center';
    context.fillText('y', centre.x, centre.y - reach * scale - 12);
    context.textBaseline = 'bottom';
    for (let radius = step; radius <= reach * (1 + 1e-9); radius += step) {
      const along = radius * scale * Math.SQRT1_2;
      this.label(context, `${tick(radius)} mm`, centre.x + along, centre.y + along + 7);
    }
  }

  /// Text on a patch of paper, so that lines do not cross it.
  label(context, text, x, y) {
    const width = context.measureText(text).width;
    context.fillStyle = theme.paper;
    context.fillRect(x - width / 2 - 3, y - 14, width + 6, 15);
    context.fillStyle = theme.quiet;
    context.fillText(text, x, y);
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
