// SPDX-License-Identifier: Apache-2.0
// What happened, newest first: marks, connections, warnings.
import { clock, count } from './words.js';

const kMost = 200;

export class Notes {
  /// Shows up to `most` of them, and says how many older ones there were.
  constructor(most = kMost) {
    this.most = most;
    this.list = document.getElementById('note-list');
    this.none = document.getElementById('no-notes');
    this.older = document.getElementById('older-notes');
    this.clear();
  }

  clear() {
    this.marks_s = [];
    this.gone = 0;
    this.list.replaceChildren();
    this.showHowMany();
  }

  /// Adds a `note`; the oldest goes where there are too many.
  add(note) {
    this.addAll([note]);
  }

  /// Adds `notes`, oldest first.
  addAll(notes) {
    const marks = notes.filter(({ kind, t_s }) => kind === 'mark' && Number.isFinite(t_s));
    this.marks_s = [...this.marks_s, ...marks.map(({ t_s }) => t_s)].slice(-this.most);
    const shown = notes.slice(-this.most);
    this.gone += notes.length - shown.length;
    this.list.prepend(...shown.map(itemOf).reverse());
    for (; this.list.children.length > this.most; ++this.gone) {
      this.list.lastElementChild.remove();
    }
    this.showHowMany();
  }

  showHowMany() {
    this.none.hidden = this.list.children.length > 0;
    this.list.hidden = !this.none.hidden;
    this.older.hidden = this.gone === 0;
    this.older.textContent = this.gone ? `${count(this.gone, 'older note')} not shown.` : '';
  }
}

function itemOf({ t_s, utc, kind, text }) {
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
  return item;
}
