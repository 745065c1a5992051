// SPDX-License-Identifier: Apache-2.0
// What a viewer may do: start and stop a recording, set a mark. Each says what came of it.
import { count, write } from './words.js';

const kTokenKey = 'penduline_token';

/// The token of the address that the program printed; out of the address bar, kept for this tab.
function takeToken() {
  const found = new URLSearchParams(location.hash.slice(1)).get('token');
  if (found) {
    history.replaceState(null, '', location.pathname);
  }
  try {
    if (found) {
      sessionStorage.setItem(kTokenKey, found);
    }
    return found ?? sessionStorage.getItem(kTokenKey);
  } catch { // where sites may store nothing the token is gone with a reload
    return found;
  }
}

export class Actions {
  /// `announce` says a sentence to all.
  constructor(announce) {
    this.announce = announce;
    this.token = takeToken();
    this.session = null;
    this.connected = false;
    this.shownHindrance = null;
    this.button = document.getElementById('record-button');
    this.words = document.getElementById('actions-words');
    this.text = document.getElementById('mark-text');
    this.button.addEventListener('click', () => this.toggle());
    document.getElementById('mark-form').addEventListener('submit', (event) => {
      event.preventDefault();
      this.mark();
    });
  }

  /// Shows what can be done with `session` (null before the first), while the program answers or not.
  show(session, connected) {
    const was = this.session?.recording ?? null;
    const first = this.session === null;
    this.session = session;
    this.connected = connected;
    const recording = session?.recording ?? null;
    const hindrance = this.hindrance();
    write(this.button, recording ? 'Stop recording' : 'Start recording');
    this.button.classList.toggle('recording', recording !== null);
    this.button.disabled = hindrance !== '' || !session?.can_record;
    this.text.disabled = hindrance !== '';
    document.getElementById('mark-button').disabled = hindrance !== '';
    const reason = hindrance || (session?.can_record ? '' : 'This source cannot be recorded.');
    // Why an action failed stays there until something else hinders.
    if (reason !== this.shownHindrance) {
      this.shownHindrance = reason;
      write(this.words, reason);
    }
    this.showDownload(session?.download ?? null);
    if (!first && (was?.name ?? null) !== (recording?.name ?? null)) {
      this.announce(recording ? `Recording into ${recording.name}.` : 'The recording has ended.');
    }
  }

  /// How much is recorded, in words.
  showRecorded(samples) {
    const recording = this.session?.recording;
    write(document.getElementById('record-words'), recording
      ? `Recording into ${recording.name}, ${count(samples ?? 0, 'sample')}.` : 'Not recording.');
  }

  showDownload(name) {
    const link = document.getElementById('download');
    link.hidden = name === null;
    if (name !== null) {
      link.download = name;
      write(link, `Download ${name}`);
    }
  }

  /// Why nothing can be done, or ''.
  hindrance() {
    if (!this.connected) {
      return 'Waiting for the program.';
    }
    if (this.session?.rate_hz === null) {
      return 'Waiting for the board.';
    }
    if (this.session?.token_needed && !this.token) {
      return 'To record and mark, open the address that the program printed; it ends in a token.';
    }
    return '';
  }

  toggle() {
    return this.post(this.session?.recording ? 'recording/stop' : 'recording/start', {});
  }

  async mark() {
    const text = this.text.value.trim() || 'mark';
    if (await this.post('mark', { text })) {
      this.text.value = '';
      this.announce(`Marked: ${text}.`);
    }
  }

  /// Whether the program did it; if not, its sentence is shown.
  async post(path, body) {
    const headers = { 'Content-Type': 'application/json', 'X-Penduline': '1' };
    if (this.token) {
      headers['X-Penduline-Token'] = this.token;
    }
    try {
      const answer = await fetch(path, { method: 'POST', headers, body: JSON.stringify(body) });
      if (answer.ok) {
        write(this.words, this.shownHindrance ?? '');
        return true;
      }
      const { error } = await answer.json().catch(() => ({}));
      this.refuse(error ?? `The program answered ${answer.status}.`);
    } catch {
      this.refuse('The program does not answer.');
    }
    return false;
  }

  refuse(sentence) {
    write(this.words, sentence);
    this.announce(sentence.endsWith('.') ? sentence : `${sentence}.`);
  }
}
