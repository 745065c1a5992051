// SPDX-License-Identifier: Apache-2.0
// The program's server-sent events; comes back by itself when the program or the network was away.
const kSilence_ms = 6000;
const kRetry_ms = 1000;

/// Opens `live` and calls `listeners[event](data)`, `listeners.opened()` before a connection's first event,
/// `listeners.lost()` when there is none and `listeners.refused()` where the program answers and gives none; for as
/// long as the page lives.
export function followLive(listeners) {
  let source = null;
  let silence = 0;

  const open = () => {
    source = new EventSource('live');
    source.addEventListener('open', () => {
      listeners.opened();
      heard();
    });
    source.addEventListener('error', () => {
      // The browser tries again by itself unless it was refused.
      if (source.readyState === EventSource.CLOSED) {
        listeners.refused();
        clearTimeout(silence);
        silence = setTimeout(reopen, kRetry_ms);
      } else {
        listeners.lost();
      }
    });
    for (const name of ['session', 'points', 'state', 'note']) {
      source.addEventListener(name, (event) => {
        heard();
        listeners[name](JSON.parse(event.data));
      });
    }
    heard();
  };
  const reopen = () => {
    source.close();
    open();
  };
  // A connection that died without a word, or was never answered: `state` comes each second.
  const heard = () => {
    clearTimeout(silence);
    silence = setTimeout(() => {
      listeners.lost();
      reopen();
    }, kSilence_ms);
  };
  open();
}
