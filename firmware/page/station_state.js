// What a station does, in words and as a shape.
import { element } from './elements.js';
import { mark } from './marks.js';
import { kFreshSeconds, live, station_age } from './live_data.js';
import { format_age } from './numbers.js';
import { word, word_of } from './words.js';

const kKinds = {
  starting: 'busy', waiting: 'good', taking_first_view: 'hold', awaiting_second_view: 'busy',
  taking_second_view: 'hold', measuring: 'busy', finished: 'away',
};

function has_fault(state) {
  return (Array.isArray(state.faults) && state.faults.length > 0) || typeof state.disk === 'string';
}

// {kind, text, is_fresh}: kind as in marks.js. Old news says nothing of now, whatever they said.
export function describe_station(station) {
  const age = station_age(station);
  const state = station.state ?? {};
  if (!live.is_fresh()) return { kind: 'away', text: word('station.unknown'), is_fresh: false };
  if (!station.is_connected) {
    return { kind: 'away', text: word('station.gone', { age: format_age(age) }), is_fresh: false };
  }
  if (age > kFreshSeconds) {
    return { kind: 'warning', text: word('station.silent', { age: format_age(age) }), is_fresh: false };
  }
  if (has_fault(state)) return { kind: 'fault', text: word('station.fault'), is_fresh: true };
  const text = word_of('state', state.state) ?? word('station.nothing_told');
  return { kind: kKinds[state.state] ?? 'busy', text, is_fresh: true };
}

export function station_line(station) {
  const { kind, text, is_fresh } = describe_station(station);
  return element('div', { class: `station ${is_fresh ? '' : 'is-old'}`, 'data-station': station.name },
    mark(kind),
    element('div', { class: 'station-words' },
      element('h3', {}, station.name),
      element('p', { class: 'station-state' }, text),
      element('p', { class: 'quiet' }, word('station.age', { age: format_age(station_age(station)) }))));
}

// Faults are the station's own sentences.
export function fault_lines(station) {
  const state = station.state ?? {};
  const faults = Array.isArray(state.faults) ? state.faults : [];
  const lines = faults.map((fault) => element('li', { lang: 'en' }, String(fault?.message ?? fault?.device ?? '')));
  if (typeof state.disk === 'string') lines.push(element('li', { lang: 'en' }, state.disk));
  return lines.length > 0 ? element('ul', { class: 'faults' }, lines) : null;
}
