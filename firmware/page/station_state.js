// What a station does, in words and as a shape.
import { element } from './elements.js';
import { mark } from './marks.js';
import { kFreshSeconds, live, station_age } from './live_data.js';
import { device_title } from './station_devices.js';
import { format_age } from './numbers.js';
import { word, word_count, word_of } from './words.js';

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

// What a till told of the next tray: "Next tray: 17, 3 foods, dinner"; null where it told nothing, and while
// a tray is being measured.
function next_tray_text(station) {
  const next = station.state?.next_tray;
  if (!next || station.state.state !== 'waiting' || !live.is_fresh()) return null;
  const parts = [next.tray, next.foods && word_count('station.foods', next.foods), ...(next.dishes ?? [])];
  return word('station.next_tray', { what: parts.filter((part) => part).join(', ') });
}

export function next_tray_line(station) {
  const text = next_tray_text(station);
  return text === null ? null : element('p', { class: 'next-tray' }, text);
}

export function station_line(station) {
  const { kind, text, is_fresh } = describe_station(station);
  return element('div', { class: `station ${is_fresh ? '' : 'is-old'}`, 'data-station': station.name },
    mark(kind),
    element('div', { class: 'station-words' },
      element('h3', {}, station.name),
      element('p', { class: 'station-state' }, text), next_tray_line(station),
      element('p', { class: 'quiet' }, word('station.age', { age: format_age(station_age(station)) }))));
}

// Faults are the station's own sentences, and so is what is wrong with its file.
export function fault_lines(station) {
  const state = station.state ?? {};
  const faults = Array.isArray(state.faults) ? state.faults : [];
  const lines = faults.map((fault) => {
    const device = String(fault?.device ?? '');
    const text = word_of('fault', fault?.status, { device: device_title(device) });
    return text === null ? element('li', { lang: 'en' }, String(fault?.message ?? device)) : element('li', {}, text);
  });
  for (const text of [state.disk, state.configuration]) {
    if (typeof text === 'string') lines.push(element('li', { lang: 'en' }, text));
  }
  return lines.length > 0 ? element('ul', { class: 'faults' }, lines) : null;
}
