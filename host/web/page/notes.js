// SPDX-License-Identifier: Apache-2.0
// What happened, newest first: marks, connections, warnings.
import { clock } from './words.js';

const kMost = 200;

export class Notes {
  constructor() {
    this.list = document.getElementById('note-list');
    this.none = document.getElementById('no-notes');
    this.clear();
  }

  clear() {
    this.marks_s = [];
    this.list.replaceChildren();
    this.showWhetherAny();
  }

  /// Adds a `note`; the oldest goes where there are too many.
  add({ t_s, utc, kind, text }) {
    const item = document.createElement('li');
    const time = document.createElement('time');
    time.textContent = clock(t_s, 1);
    if (utc) {
      time.dateTime = utc;
      time.title = utc;
    }
    const word = document.createElement('b');
    word.textContent = kind;
    const sentence = document.createElement('span');
    sentence.textContent = text;
    item.append(time, word, sentence);
    this.list.prepend(item);
    if (this.list.children.length > kMost) {
      this.list.lastElementChild.remove();
    }
    if (kind === 'mark' && Number.isFinite(t_s)) {
      this.marks_s = [...this.marks_s, t_s].slice(-kMost);
    }
    this.showWhetherAny();
  }

  showWhetherAny() {
    this.none.hidden = this.list.children.length > 0;
    this.list.hidden = !this.none.hidden;
  }
}
