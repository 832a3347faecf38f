// The live view: what each station does, and the last tray.
import { element } from './elements.js';
import { show_first_steps } from './first_steps.js';
import { follow, live } from './live_data.js';
import { scan_body } from './scan_figures.js';
import { no_scan_text, scan_line } from './scan_head.js';
import { Selection } from './selection.js';
import { scan_address } from './sentences.js';
import { fault_lines, station_line } from './station_state.js';
import { show_tray } from './tray_panel.js';
import { word } from './words.js';

function show_stations(frame) {
  if (live.stations.length === 0) {
    const key = live.answered_at === null ? 'page.loading' : 'live.no_station';
    frame.replaceChildren(element('p', { class: 'quiet' }, word(key)));
    return;
  }
  frame.replaceChildren(...live.stations.map((station) => {
    const line = station_line(station);
    line.querySelector('.station-words').append(fault_lines(station) ?? '');
    return line;
  }));
}

// Returns what closes the drawing of the tray.
function show_scan(frame, scan) {
  if (scan === null) {
    frame.replaceChildren(element('p', { class: 'quiet' }, no_scan_text()));
    return live.is_latest_known && live.store_problem === null ? show_first_steps(frame) : () => {};
  }
  const selection = new Selection();
  const tray = element('div', {});
  const close = show_tray(tray, scan, selection);
  frame.replaceChildren(
    element('div', { class: 'scan-head' },
      element('h2', {}, word('live.last_tray')),
      element('a', { href: scan_address(scan.id) }, scan.id), scan_line(scan)),
    scan_body(scan, selection, tray));
  return close;
}

export function show_live(main, parameters, signal) {
  const stations = element('div', { class: 'stations' });
  const last = element('section', { class: 'card last-tray', 'aria-label': word('live.last_tray') });
  main.append(
    element('h1', { class: 'unseen' }, word('live.title')),
    element('section', { class: 'card', 'aria-label': word('live.stations') },
      element('h2', { class: 'unseen' }, word('live.stations')), stations),
    last);
  follow(['stations', 'age'], signal, () => show_stations(stations));
  let close = () => {};
  let shown;
  follow(['latest'], signal, () => {
    // The same scan is left alone, so that neither focus nor a turned drawing is lost.
    const text = JSON.stringify([live.latest, no_scan_text()]);
    if (text === shown) return;
    shown = text;
    close();
    close = show_scan(last, live.latest);
  });
  signal.addEventListener('abort', () => close());
}
