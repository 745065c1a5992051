// SPDX-License-Identifier: Apache-2.0
// Sentences for those who hear the page.
const kPause_ms = 100; // in which a screen reader notices that the element is empty

/// Says sentences by a status element: one that is the same as before, too, and all that come in one moment.
export class Announcer {
  constructor(element) {
    this.element = element;
    this.waiting = [];
    this.timer = 0;
  }

  say(sentence) {
    this.element.textContent = '';
    this.waiting.push(sentence);
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      this.element.textContent = this.waiting.splice(0).join(' ');
    }, kPause_ms);
  }
}
