// SPDX-License-Identifier: Apache-2.0
// The five pictures of one session, what they span, and each one's caption in words.
import { aboveWords, anglesWords, gapsWords, signalsWords, spaceWords } from './captions.js';
import { SteadyReach } from './reach.js';
import { SpaceView } from './space_view.js';
import { TimePlot } from './time_plot.js';
import { TopView } from './top_view.js';
import { write } from './words.js';

const kTrail_s = 12;

export class Views {
  /// Shows `series` of `session`; `choices`: onZoom(span) and onMoment(t_s) or none, where the pointer may do these.
  constructor(session, series, painter, choices = {}) {
    this.series = series;
    this.painter = painter;
    this.sensors = session.rig.sensors;
    /// What is shown: from and to (s), the moment of the mass (s), marks (s), the ellipse of `state`,
    /// and when that was, where it is not the latest.
    this.scene = { span: [0, 1], trailFrom_s: 0, moment_s: NaN, marks_s: [], ellipse: null, ellipseSpan: null };
    this.section = (id) => document.getElementById(id);
    this.addAngles(choices);
    this.addSensors(choices);
    this.addPaths(session.rig);
  }

  addAngles(choices) {
    const steady = new SteadyReach(0.1);
    this.addPlot('angles', {
      ...choices, unit: '°', tickUnit: '°', decimals: 3,
      curves: [1, 2].map((i) => ({ column: `theta${i}`, sigma: `sigma${i}`, label: `θ${'₁₂'[i - 1]}` })),
      reach: (series, from, to) => {
        const measured = ['theta1', 'theta2'].flatMap((column) => series.extremes(column, from, to));
        const known = measured.filter(Number.isFinite).map(Math.abs);
        const reach = steady.fit(known.length ? Math.max(...known) : NaN);
        return [-reach, reach];
      },
    });
  }

  addSensors(choices) {
    this.addSensorPlot('gaps', 'gap', { ...choices, unit: 'mm', tickUnit: '', decimals: 3 },
      this.sensors.map((sensor) => ends(sensor.gap_range_m, 1000)));
    this.addSensorPlot('signals', 'signal', { ...choices, unit: 'V', tickUnit: '', decimals: 4 },
      this.sensors.map((sensor) => ends(sensor.signal_range_v, 1)));
  }

  /// Spans the valid ranges, and what is measured beyond them: by half of all that is valid at most, for a response
  /// says nothing of what lies farther out.
  addSensorPlot(id, column, description, ranges) {
    const curves = this.sensors.map((sensor, i) => ({ column: `${column}${i}`, label: sensor.name }));
    const wide = new SteadyReach(0.01, 1.04);
    const [bottom, top] = widened(ranges);
    this.addPlot(id, {
      ...description, curves, ranges,
      reach: (series, from, to) => {
        const measured = curves.flatMap((curve) => series.extremes(curve.column, from, to));
        const shown = measured.filter(Number.isFinite).map((value) => Math.max(bottom, Math.min(top, value)));
        const all = [...ranges.flat().filter(Number.isFinite), ...shown];
        const low = Math.min(0, ...all);
        return [low < 0 ? 1.1 * low : 0, wide.fit(all.length ? Math.max(...all) : NaN)];
      },
    });
  }

  addPlot(id, description) {
    const section = this.section(id);
    const plot = new TimePlot(section, description);
    this.painter.add(plot.host, () => plot.draw(this.series, this.scene.span, this.scene.marks_s));
    if (description.onZoom) {
      plot.plot.over.addEventListener('dblclick', () => description.onZoom(null));
    }
  }

  addPaths(rig) {
    const above = new TopView(this.section('above'));
    this.painter.add(above.canvas, () => {
      const [from, to, now] = this.trail();
      above.draw(this.series, from, to, now, this.scene.ellipse);
    });
    this.space = new SpaceView(this.section('space'), rig, () => {
      this.painter.changed(this.space.canvas, true);
      this.caption();
    });
    this.painter.add(this.space.canvas, () => this.space.draw(this.series, ...this.trail()));
  }

  /// Rows [from, to) of the trail, and the mass's.
  trail() {
    const { series, scene } = this;
    const to = Math.min(series.end, series.rowAt(scene.moment_s) + 1);
    return [series.rowAt(Math.max(scene.trailFrom_s, scene.moment_s - kTrail_s)), to, to > series.begin ? to - 1 : -1];
  }

  /// The captions are for reading: to be called once a second or less.
  caption() {
    const { series, scene, sensors } = this;
    const rows = [series.rowAt(scene.span[0]), Math.min(series.end, series.rowAt(scene.span[1]) + 1)];
    const [, , now] = this.trail();
    write(this.section('angles-words'), anglesWords(series, rows));
    write(this.section('above-words'), aboveWords(scene.ellipse, scene.ellipseSpan));
    write(this.section('gaps-words'), gapsWords(series, now, sensors));
    write(this.section('signals-words'), signalsWords(series, now, sensors));
    write(this.section('space-words'), spaceWords(series, now, this.space.camera.direction));
  }
}

/// All ranges and half of their extent on either side; for ever where they have no end.
function widened(ranges) {
  const [least, greatest] = [Math.min(...ranges.flat()), Math.max(...ranges.flat())];
  const room = Number.isFinite(greatest - least) ? (greatest - least) / 2 : Infinity;
  return [least - room, greatest + room];
}

/// A valid range in other units; a range that has no end there (null) goes on for ever.
function ends(range, scale) {
  const [least, greatest] = range ?? [null, null];
  return [least === null ? -Infinity : least * scale, greatest === null ? Infinity : greatest * scale];
}
