// For a screen beside the station: nothing to press, to be read from two metres.
import { element } from './elements.js';
import { get } from './hub_api.js';
import { follow, live } from './live_data.js';
import { mark } from './marks.js';
import { format_measured, format_volume } from './numbers.js';
import { no_scan_text, tray_notices } from './scan_head.js';
import { is_refused, item_name, warning_list, why_no_volume } from './sentences.js';
import { describe_station, next_tray_line } from './station_state.js';
import { format_recent } from './times.js';
import { word } from './words.js';

function state_block(station) {
  const { kind, text, is_fresh } = describe_station(station);
  return element('div', { class: `kiosk-state kiosk-${kind} ${is_fresh ? '' : 'is-old'}` }, mark(kind),
    element('div', {}, element('p', { class: 'kiosk-station' }, station.name),
      element('p', { class: 'kiosk-words' }, text), next_tray_line(station)));
}

function show_states(frame, name) {
  const stations = live.stations.filter((station) => name === null || station.name === name);
  if (stations.length > 0) return frame.replaceChildren(...stations.map(state_block));
  const key = live.answered_at === null ? 'page.loading' : 'live.no_station';
  return frame.replaceChildren(element('p', { class: 'kiosk-words' }, word(key)));
}

function item_line(item) {
  const volume = item.volume_ml === null ? element('span', { class: 'kiosk-why' }, why_no_volume(item))
    : element('span', { class: 'kiosk-volume' }, format_measured(item.volume_ml, item.sigma_ml));
  return element('li', {}, element('span', { class: 'kiosk-name' }, item_name(item)), volume);
}

// Few items are written large, forty still fit.
function size_of(count) {
  if (count <= 4) return 'few';
  return count <= 10 ? 'some' : 'many';
}

function show_scan(frame, scan) {
  if (scan === null) {
    frame.replaceChildren(element('p', { class: 'quiet' }, no_scan_text()));
    return;
  }
  const items = scan.items.filter((item) => !item.is_wrong);
  frame.replaceChildren(
    element('h2', {}, word('live.last_tray'), ' ',
      element('span', { class: 'quiet' }, format_recent(scan.taken_at))),
    ...tray_notices(scan),
    element('ul', { class: `kiosk-items kiosk-${size_of(items.length)}` }, items.map(item_line)),
    is_refused(scan) ? '' : element('p', { class: 'kiosk-total' }, element('span', {}, word('scan.total')),
      element('span', { class: 'kiosk-volume' }, format_volume(scan.volume_ml))),
    warning_list(scan) ?? '');
}

// Of one station where the address names it, else whichever arrived last.
async function last_scan(name) {
  if (name === null || live.latest?.station === name) return live.latest;
  const { scans } = await get(`scans?limit=1&station=${encodeURIComponent(name)}`);
  return scans[0] ?? null;
}

export function show_kiosk(main, parameters, signal) {
  const name = parameters.path[0] ?? null;
  const states = element('section', { class: 'kiosk-states', 'aria-label': word('live.stations') });
  const last = element('section', { class: 'kiosk-scan', 'aria-label': word('live.last_tray') });
  main.append(element('h1', { class: 'unseen' }, word('kiosk.title')), states, last);
  follow(['stations', 'age'], signal, () => show_states(states, name));
  follow(['latest'], signal, async () => {
    // Where this fails the band on top says so, and the next news asks again.
    const scan = await last_scan(name).catch(() => undefined);
    if (scan !== undefined && !signal.aborted) show_scan(last, scan);
  });
}
