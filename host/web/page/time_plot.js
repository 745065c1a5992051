// SPDX-License-Identifier: Apache-2.0
// Curves of columns against time by uPlot: bands, valid ranges, marks, the value under the pointer.
import uPlot from 'uplot';
import './licences.js';
import { rowsToDraw } from './decimate.js';
import { clock, fixed, ticks } from './words.js';
import { curveColour, faded, theme } from './theme.js';

const kAxisFont_px = 12;
const kHeightOfXAxis_px = 26;
const kHeightOfXLabel_px = 16;
const kWidthOfYAxis_px = 46;
const kGapOfYAxis_px = 8;
const kTimeSteps_s = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1200, 1800, 3600, 7200,
  14400];

/**
 * One plot in `section`.
 * `description`: `curves`, each with `column`, `label` and, for a band, `sigma`'s column; `unit` and `decimals` of a
 * value, `tickUnit` of the axis; `ranges`: what is valid for each curve, [least, greatest], shaded;
 * `reach(series, from, to)`: [least, greatest] of the y axis; where the pointer may do so, `onZoom(span)` and
 * `onMoment(t_s)`.
 */
export class TimePlot {
  constructor(section, description) {
    this.description = description;
    this.host = section.querySelector('.plot');
    this.key = section.querySelector('.key');
    this.span = [0, 1];
    this.reach = [0, 1];
    this.marks_s = [];
    this.axis_px = kWidthOfYAxis_px;
    this.plot = new uPlot(this.options(), this.empty(), this.host);
    this.showKey();
  }

  options() {
    const { curves } = this.description;
    const axis = { stroke: () => theme.quiet, ticks: { show: false }, font: `${kAxisFont_px}px ${theme.font}` };
    const grid = { stroke: () => theme.grid, width: 1 };
    const band = { width: 0, points: { show: false } };
    const series = [{}];
    const bands = [];
    curves.forEach((curve, i) => {
      series.push({ label: curve.label, stroke: () => curveColour(i), width: 1.75, points: { show: false } });
    });
    curves.forEach((curve, i) => {
      if (curve.sigma) {
        bands.push({ series: [series.length, series.length + 1], fill: () => faded(curveColour(i), 0.22) });
        series.push({ ...band }, { ...band });
      }
    });
    return {
      ...this.size(), series, bands, legend: { show: false }, padding: [8, 14, 0, 0],
      scales: { x: { time: false, range: () => this.span }, y: { range: () => this.reach } },
      axes: [
        { ...axis, grid: { show: false }, size: kHeightOfXAxis_px, gap: 4, space: 70, incrs: kTimeSteps_s,
          label: 'time since the start, min:s', labelSize: kHeightOfXLabel_px, labelFont: axis.font, labelGap: 0,
          values: (u, moments) => this.timeTicks(moments) },
        { ...axis, grid, size: (u, labels) => this.widthOfYAxis(u, labels), gap: kGapOfYAxis_px, space: 40,
          values: (u, values) => ticks(values).map((text) => `${text}${this.description.tickUnit}`) },
      ],
      cursor: {
        x: true, y: false, points: { show: false },
        drag: { x: Boolean(this.description.onZoom), y: false, setScale: false },
      },
      hooks: {
        drawClear: [(u) => this.shade(u)], draw: [(u) => this.drawMarks(u)],
        setCursor: [(u) => this.showKey(u.cursor.idx)], setSelect: [(u) => this.zoom(u)],
      },
    };
  }

  /// It grows to the widest label so far: an axis that shrinks again would move the plot.
  widthOfYAxis(u, labels) {
    u.ctx.save();
    u.ctx.font = u.axes[1].font[0];
    const widest_px = Math.max(0, ...(labels ?? []).map((label) => u.ctx.measureText(label).width)) / devicePixelRatio;
    u.ctx.restore();
    this.axis_px = Math.max(this.axis_px, Math.ceil(widest_px) + kGapOfYAxis_px + 4);
    return this.axis_px;
  }

  size() {
    return { width: Math.max(200, this.host.clientWidth), height: Math.max(120, this.host.clientHeight) };
  }

  empty() {
    const bands = this.description.curves.filter((curve) => curve.sigma).length;
    return Array.from({ length: 1 + this.description.curves.length + 2 * bands }, () => []);
  }

  /// None before the start, where a plot is not yet full.
  timeTicks(moments_s) {
    const step_s = moments_s.length > 1 ? moments_s[1] - moments_s[0] : 1;
    const decimals = step_s >= 1 ? 0 : step_s >= 0.1 ? 1 : 2;
    return moments_s.map((t_s) => (t_s < 0 ? '' : clock(t_s, decimals)));
  }

  /// Draws `series` from `span[0]` to `span[1]` (s), with the moments `marks_s`.
  draw(series, span, marks_s) {
    const { curves, reach } = this.description;
    const size = this.size();
    if (size.width !== this.plot.width || size.height !== this.plot.height) {
      this.plot.setSize(size);
    }
    const { columns } = series;
    const from = Math.max(series.begin, series.rowAt(span[0]) - 1);
    const to = Math.min(series.end, series.rowAt(span[1]) + 1);
    const drawn = curves.map((curve) => columns[curve.column]);
    const rows = rowsToDraw(columns.t, drawn, from, to, size.width * devicePixelRatio);
    const data = [Array.from(rows, (row) => columns.t[row])];
    for (const { column } of curves) {
      data.push(rows.map((row) => orNull(columns[column][row])));
    }
    for (const { column, sigma } of curves.filter((curve) => curve.sigma)) {
      data.push(rows.map((row) => orNull(columns[column][row] + columns[sigma][row])));
      data.push(rows.map((row) => orNull(columns[column][row] - columns[sigma][row])));
    }
    this.span = span;
    this.reach = reach(series, from, to);
    this.marks_s = marks_s;
    this.plot.setData(data);
    // What the axes span, and the marks in between, for whoever reads the picture by program.
    const seen_s = marks_s.filter((t_s) => t_s >= span[0] && t_s <= span[1]);
    this.host.dataset.axes = JSON.stringify({ t_s: this.span, value: this.reach, marks_s: seen_s });
  }

  /// Behind the curves: what each sensor can measure, darker where several can, its ends as lines.
  shade(u) {
    const { left, top, width, height } = u.bbox;
    const { ctx } = u;
    ctx.save();
    (this.description.ranges ?? []).forEach((range, i) => {
      const [low, high] = range.map((value) =>
        Math.min(top + height, Math.max(top, u.valToPos(value, 'y', true))));
      ctx.fillStyle = faded(theme.quiet, 0.07);
      ctx.fillRect(left, high, width, low - high);
      ctx.strokeStyle = faded(curveColour(i), 0.7);
      ctx.lineWidth = devicePixelRatio;
      ctx.setLineDash([2 * devicePixelRatio, 3 * devicePixelRatio]);
      ctx.beginPath();
      for (const y of [low, high]) {
        ctx.moveTo(left, Math.round(y) + 0.5);
        ctx.lineTo(left + width, Math.round(y) + 0.5);
      }
      ctx.stroke();
    });
    ctx.restore();
  }

  drawMarks(u) {
    const { left, top, width, height } = u.bbox;
    const { ctx } = u;
    ctx.save();
    ctx.strokeStyle = theme.ink;
    ctx.lineWidth = devicePixelRatio;
    ctx.setLineDash([devicePixelRatio, 3 * devicePixelRatio]);
    for (const t_s of this.marks_s) {
      const x = u.valToPos(t_s, 'x', true);
      if (x >= left && x <= left + width) {
        ctx.beginPath();
        ctx.moveTo(Math.round(x) + 0.5, top);
        ctx.lineTo(Math.round(x) + 0.5, top + height);
        ctx.stroke();
      }
    }
    ctx.restore();
  }

  /// Which colour is what; with a row under the pointer, its values.
  showKey(index = null) {
    const { curves, unit, decimals, onMoment } = this.description;
    const parts = curves.map(({ label }, i) => {
      const item = document.createElement('span');
      item.className = `curve${i % 4}`;
      const value = index === null ? NaN : this.plot.data[i + 1][index];
      item.textContent = index === null ? label : `${label} ${fixed(value, decimals, decimals + 4)}\u00a0${unit}`;
      return item;
    });
    if (index !== null) {
      parts.unshift(`at ${clock(this.plot.data[0][index], 2)}`);
      onMoment?.(this.plot.data[0][index]);
    }
    this.key.replaceChildren(...parts.flatMap((part) => [part, ' ']));
  }

  zoom(u) {
    const { left, width } = u.select;
    if (width > 4) {
      this.description.onZoom([u.posToVal(left, 'x'), u.posToVal(left + width, 'x')]);
      u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    }
  }
}

function orNull(value) {
  return Number.isNaN(value) ? null : value;
}
