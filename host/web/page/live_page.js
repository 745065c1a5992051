// SPDX-License-Identifier: Apache-2.0
// The page beside a running program: events in, pictures and words out.
import { Actions } from './actions.js';
import { Announcer } from './announcer.js';
import { followLive } from './live_events.js';
import { Notes } from './notes.js';
import { Painter } from './painter.js';
import { showAngles, showSwing } from './readouts.js';
import { liveStep_s, Series } from './series.js';
import { showSession } from './session_words.js';
import { followTheme } from './theme.js';
import { Views } from './views.js';
import { write } from './words.js';

const kShown_s = 30;
// A minute at the most rows that the program sends.
const kCapacity = 40000;
const kReadout_ms = 200;

export class LivePage {
  constructor() {
    this.painter = new Painter();
    this.notes = new Notes();
    this.announcer = new Announcer(document.getElementById('announcement'));
    this.actions = new Actions((sentence) => this.announcer.say(sentence));
    this.session = null;
    this.state = null;
    this.views = null;
    this.fresh = true;
    this.hadBoard = false;
    this.readout_ms = -Infinity;
    followTheme(() => this.painter.changed());
    followLive({
      opened: () => this.opened(), session: (session) => this.takeSession(session),
      points: (points) => this.takePoints(points), state: (state) => this.takeState(state),
      note: (note) => this.takeNote(note),
      lost: () => this.lost('The program does not answer; trying again'),
      refused: () => this.lost('The program takes no more viewers now; trying again'),
    });
  }

  /// A connection begins with all that it needs: what was shown gives way to it.
  opened() {
    this.fresh = true;
    this.notes.clear();
    this.showMarks();
  }

  lost(sentence) {
    this.connection('lost', sentence);
    this.actions.show(this.session, false);
  }

  takeSession(session) {
    const before = this.session;
    if (before && JSON.stringify(before.rig) !== JSON.stringify(session.rig)) {
      location.reload();
      return;
    }
    this.session = session;
    if (!before) {
      this.series = new Series(kCapacity, session.rig.sensors.length, liveStep_s(session.rate_hz));
      this.views = new Views(session, this.series, this.painter);
    }
    this.series.largestStep_s = liveStep_s(session.rate_hz);
    write(document.getElementById('origin'), [session.rig.name, session.source].filter(Boolean).join(' · '));
    write(document.getElementById('program'), session.program);
    document.title = `${session.recording ? '● ' : ''}Penduline · ${session.source}`;
    this.actions.show(session, true);
    this.actions.showRecorded(this.state?.recorded_samples);
  }

  takePoints(points) {
    if (this.fresh) {
      this.series.clear();
      this.fresh = false;
    }
    this.series.append(points);
    const { scene } = this.views;
    const latest_s = Number.isNaN(this.series.latest_s) ? 0 : this.series.latest_s;
    scene.span = [latest_s - kShown_s, latest_s];
    scene.moment_s = latest_s;
    this.painter.changed();
    const now_ms = performance.now();
    if (now_ms - this.readout_ms > kReadout_ms) {
      this.readout_ms = now_ms;
      showAngles(this.series, this.series.end - 1);
    }
  }

  takeState(state) {
    const was = this.state?.connected;
    this.state = state;
    if (state.connected) {
      this.connection('live', 'Live');
    } else {
      this.connection('waiting', 'The board is not there; waiting for it');
      showAngles(this.series, -1);
    }
    if (was === false && state.connected) {
      this.announcer.say(this.hadBoard ? 'The board is back.' : 'The board is there.');
    }
    this.hadBoard ||= state.connected;
    this.views.scene.ellipse = state.ellipse;
    showSwing(state);
    showSession(this.session, state);
    this.actions.showRecorded(state.recorded_samples);
    this.views.caption();
  }

  takeNote(note) {
    this.notes.add(note);
    this.showMarks();
  }

  showMarks() {
    if (this.views) {
      this.views.scene.marks_s = this.notes.marks_s;
      this.painter.changed();
    }
  }

  /// Shown at once, said aloud only when it changes.
  connection(state, sentence) {
    const element = document.getElementById('connection');
    element.dataset.state = state;
    if (element.textContent !== sentence) {
      element.textContent = sentence;
      this.announcer.say(`${sentence}.`);
    }
  }
}
