// SPDX-License-Identifier: Apache-2.0
// The page with a recording inside: the whole of it, with zoom, analysis and rig.
import { Notes } from './notes.js';
import { Painter } from './painter.js';
import { showAngles, showSwing } from './readouts.js';
import { decodedPoints } from './recorded_points.js';
import { Series } from './series.js';
import { showSession } from './session_words.js';
import { followTheme } from './theme.js';
import { Views } from './views.js';
import { clock, typeset, write } from './words.js';

const kLeast_s = 0.2;
const kMostNotes = 5000; // what a browser lays out at once
const kKeys = { '+': 0.5, '=': 0.5, '-': 2 };

export class RecordedPage {
  constructor({ session, state, recorded, notes, analysis, rig_toml, points, bin_s = 0 }) {
    const painter = new Painter();
    followTheme(() => painter.changed());
    this.painter = painter;
    const decoded = decodedPoints(points);
    // Rows that are left of many say themselves where dropouts are, see ReportRows.
    const largestStep_s = bin_s > 0 ? Infinity : 3.5 / (session.rate_hz || 20);
    this.series = new Series(decoded.t_s.length + 1, session.rig.sensors.length, largestStep_s);
    this.series.append(decoded);
    const { t } = this.series.columns;
    this.whole = this.series.end ? [t[0], this.series.latest_s] : [0, 1];
    this.views = new Views(session, this.series, painter,
      { onZoom: (span) => this.zoom(span ?? this.whole), onMoment: (t_s) => this.showMoment(t_s) });
    this.showWords(session, state, recorded, analysis, rig_toml);
    const list = new Notes(kMostNotes);
    list.addAll(notes);
    this.views.scene.marks_s = list.marks_s;
    this.views.scene.ellipse = state.ellipse;
    const { analysed } = recorded;
    this.views.scene.ellipseSpan = analysed && [analysed.from_s, analysed.first_swing_to_s];
    for (const plot of document.querySelectorAll('.plot')) {
      plot.tabIndex = 0;
      plot.addEventListener('keydown', (event) => this.key(event));
    }
    this.zoom(this.whole);
  }

  showWords(session, state, recorded, analysis, rigToml) {
    write(document.getElementById('origin'), [session.rig.name, session.source].filter(Boolean).join(' · '));
    write(document.getElementById('program'), session.program);
    write(document.getElementById('connection'), 'A recording');
    document.title = `Penduline · ${session.source}`;
    showSwing(state);
    if (recorded.analysed) {
      write(document.getElementById('amplitude-span'), `at ${clock(recorded.analysed.from_s, 1)}`);
    }
    showSession(session, state, recorded);
    write(document.getElementById('rig-text'), rigToml);
    const body = document.getElementById('analysis-rows');
    for (const [name, value] of analysis) {
      const row = body.insertRow();
      const head = document.createElement('th');
      head.scope = 'row';
      head.textContent = typeset(name);
      row.append(head);
      row.insertCell().textContent = typeset(value);
    }
  }

  zoom([from_s, to_s]) {
    const middle_s = (from_s + to_s) / 2;
    const half_s = Math.max(kLeast_s, to_s - from_s) / 2;
    const span = [Math.max(this.whole[0], middle_s - half_s), Math.min(this.whole[1], middle_s + half_s)];
    this.views.scene.span = span;
    this.views.scene.trailFrom_s = span[0];
    this.showMoment(span[1]);
    this.painter.changed(null, true);
    this.views.caption();
  }

  showMoment(t_s) {
    this.views.scene.moment_s = t_s;
    showAngles(this.series, Math.min(this.series.end - 1, this.series.rowAt(t_s)));
    for (const canvas of document.querySelectorAll('section > canvas')) {
      this.painter.changed(canvas, true);
    }
  }

  key(event) {
    const [from_s, to_s] = this.views.scene.span;
    const width_s = to_s - from_s;
    if (event.key in kKeys) {
      const half_s = (width_s * kKeys[event.key]) / 2;
      this.zoom([(from_s + to_s) / 2 - half_s, (from_s + to_s) / 2 + half_s]);
    } else if (event.key === 'ArrowLeft' || event.key === 'ArrowRight') {
      const wanted_s = (event.key === 'ArrowLeft' ? -0.25 : 0.25) * width_s;
      const step_s = Math.max(this.whole[0] - from_s, Math.min(this.whole[1] - to_s, wanted_s));
      this.zoom([from_s + step_s, to_s + step_s]);
    } else if (event.key === 'Home') {
      this.zoom(this.whole);
    } else {
      return;
    }
    event.preventDefault();
  }
}
