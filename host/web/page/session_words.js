// SPDX-License-Identifier: Apache-2.0
// The state of the session in sentences.
import { clock, count, fixed, shortest, typeset, write } from './words.js';

/// Shows `session` and `state` as a list of terms and sentences; what did not change is left alone. Of a recording
/// `recorded` says what all of it has come to.
export function showSession(session, state, recorded = null) {
  const list = document.getElementById('session-words');
  const rows = sentences(session, state, recorded);
  while (list.children.length > rows.length) {
    list.lastElementChild.remove();
  }
  rows.forEach(([term, sentence], i) => {
    const row = list.children[i] ?? list.appendChild(emptyRow());
    write(row.children[0], term);
    write(row.children[1], sentence);
  });
}

function emptyRow() {
  const row = document.createElement('div');
  row.append(document.createElement('dt'), document.createElement('dd'));
  return row;
}

/// Pairs of a term and a sentence.
export function sentences(session, state, recorded = null) {
  const rows = [['Board', boardSentence(session, state)], ['Rate', rateSentence(session, state)],
    ['Samples', samplesSentence(state)]];
  if (recorded) {
    rows.push(['Angles', recordedAnglesSentence(state, recorded)],
      ['Light', recordedLightSentence(session, recorded.sensors)],
      ['Signals', recordedSignalSentence(session, recorded.sensors)]);
  } else if (state.sensors?.length) {
    const { sensors } = state;
    rows.push(['Light', lightSentence(session, sensors)], ['Signals', signalSentence(session, sensors)]);
  }
  if (state.flags?.length) {
    rows.push(['Flags', flagsSentence(state.flags)]);
  }
  if (state.clock) {
    rows.push(['Clock', capital(typeset(state.clock))]);
  }
  rows.push(['Rig', rigSentence(session)]);
  return rows;
}

function boardSentence({ source, board, firmware, serial }, { connected }) {
  if (connected === false) {
    return `${board ?? 'The board'} is not there; waiting for it at ${source}.`;
  }
  if (!board || board === 'sim') {
    return board ? 'None: the rig is simulated.' : `None: the samples come from ${source}.`;
  }
  const parts = [board, firmware && `firmware ${firmware}`, serial && `serial number ${serial}`, `at ${source}`];
  return `${parts.filter(Boolean).join(', ')}.`;
}

function rateSentence(session, state) {
  if (!Number.isFinite(session.rate_hz)) {
    return 'Not known before the board is there.';
  }
  const wanted = `${shortest(session.rate_hz, 3)} Hz`;
  return Number.isFinite(state.rate_hz) ? `${fixed(state.rate_hz, 2)} Hz of ${wanted} asked for.` : `${wanted} asked for.`;
}

function samplesSentence({ samples, lost, dropouts, restarts }) {
  return capital(`${count(samples, 'sample')}, ${count(lost, 'lost sample')}, ${count(dropouts, 'dropout')}, ` +
    `${count(restarts, 'restart')} of the board.`);
}

function lightSentence({ rig }, sensors) {
  const measured = sensors.map(({ ambient_v }, i) => [rig.sensors[i]?.name ?? i + 1, ambient_v])
    .filter(([, ambient_v]) => Number.isFinite(ambient_v));
  return measured.length
    ? `Ambient light gives ${measured.map(([name, ambient_v]) => `${fixed(ambient_v, 3)} V at ${name}`).join(', ')}.`
    : 'Ambient light is not measured.';
}

function signalSentence({ rig, reference_v }, sensors) {
  const name = (i) => rig.sensors[i]?.name ?? String(i + 1);
  const troubles = sensors.flatMap(({ signal_v, saturated, out_of_range }, i) => [
    ...(signal_v === null ? [`${name(i)} is not read`] : []),
    ...(saturated ? [`${name(i)} is saturated`] : []),
    ...(out_of_range ? [`${name(i)} is out of its range`] : []),
  ]);
  if (sensors.some(({ saturated }) => saturated === null)) {
    troubles.unshift('One sensor is saturated, which one is not known');
  }
  const trouble = troubles.length ? troubles.join('; ') : 'None is saturated or out of its range';
  return Number.isFinite(reference_v) ? `${trouble}; full scale is ${fixed(reference_v, 2)} V.` : `${trouble}.`;
}

function recordedAnglesSentence({ samples }, { with_angles }) {
  const without = samples - with_angles;
  return without === 0 ? 'Every sample has angles.' : capital(`${count(without, 'sample')} without angles.`);
}

function recordedLightSentence({ rig }, sensors) {
  const measured = sensors.map(({ ambient_v }, i) => [rig.sensors[i]?.name ?? i + 1, ambient_v])
    .filter(([, ambient_v]) => ambient_v !== null)
    .map(([name, ends]) => `${[...new Set(ends.map((volts) => fixed(volts, 3)))].join(' to ')} V at ${name}`);
  return measured.length ? `Ambient light gave ${measured.join(', ')}.` : 'Ambient light was not measured.';
}

function recordedSignalSentence({ rig, reference_v }, sensors) {
  const troubles = sensors.flatMap(({ saturated, out_of_range, missing }, i) => [
    ...(saturated ? [`saturated in ${count(saturated, 'sample')}`] : []),
    ...(out_of_range ? [`out of its range in ${count(out_of_range, 'sample')}`] : []),
    ...(missing ? [`not read in ${count(missing, 'sample')}`] : []),
  ].map((trouble, n) => (n === 0 ? `${rig.sensors[i]?.name ?? i + 1} was ${trouble}` : trouble)));
  const unknown = Math.max(...sensors.map(({ maybe_saturated }) => maybe_saturated));
  if (unknown > 0) {
    troubles.unshift(`One sensor was saturated in ${count(unknown, 'sample')}, which one is not known`);
  }
  const trouble = troubles.length ? troubles.join(', ') : 'None was saturated or out of its range in any sample';
  return Number.isFinite(reference_v) ? `${trouble}; full scale is ${fixed(reference_v, 2)} V.` : `${trouble}.`;
}

function flagsSentence(flags) {
  return capital(flags.map(({ name, count: times, latest_s }) => {
    const often = times === 1 ? 'once' : count(times, 'time');
    return `${name.replaceAll('_', ' ')} ${often}, last at ${clock(latest_s, 1)}`;
  }).join('; '));
}

function rigSentence({ rig, estimator }) {
  return `${rig.name ?? 'Unnamed'}, ${fixed(1000 * rig.length_m, 0)} mm long, ${count(rig.sensors.length, 'sensor')}; ` +
    `angles by ${estimator}.`;
}

function capital(sentence) {
  const text = sentence.charAt(0).toUpperCase() + sentence.slice(1);
  return text.endsWith('.') ? text : `${text}.`;
}
