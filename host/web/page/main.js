// SPDX-License-Identifier: Apache-2.0
// The same page beside a running program and, with a recording inside, alone.
import { LivePage } from './live_page.js';
import { RecordedPage } from './recorded_page.js';

const recording = document.getElementById('recording');
document.documentElement.classList.add(recording ? 'recorded' : 'live');
if (recording) {
  new RecordedPage(JSON.parse(recording.textContent));
} else {
  new LivePage();
}
