// Whether everything works: hub, stations, their devices, and what the store holds.
import { drift_figures } from './drift_figures.js';
import { element } from './elements.js';
import { error_note } from './error_note.js';
import { get_health, get_metrics } from './hub_api.js';
import { health_list } from './health_parts.js';
import { follow, live } from './live_data.js';
import { device_list } from './station_devices.js';
import { fault_lines, station_line } from './station_state.js';
import { state_facts } from './state_facts.js';
import { read_figures, store_figures } from './store_figures.js';
import { word } from './words.js';

const kPeriodMs = 5000;

function station_card(station, figures) {
  const line = station_line(station);
  line.querySelector('.station-words').append(
    fault_lines(station) ?? '', device_list(station) ?? '', state_facts(station),
    drift_figures(figures, station.name) ?? '');
  return line;
}

function show_stations(frame, figures) {
  const nothing = element('p', { class: 'quiet' }, word('live.no_station'));
  const cards = live.stations.map((station) => station_card(station, figures));
  frame.replaceChildren(...(cards.length > 0 ? cards : [nothing]));
}

// Returns the hub's figures; where they did not come, those that came last.
async function show_health(health, store, last) {
  try {
    const [told, metrics] = await Promise.all([get_health(), get_metrics()]);
    health.replaceChildren(health_list(told));
    const figures = read_figures(metrics);
    store.replaceChildren(store_figures(figures));
    return figures;
  } catch (error) {
    health.replaceChildren(error_note(error));
    return last;
  }
}

function section(id, key, body) {
  return element('section', { class: 'card', 'aria-labelledby': id }, element('h2', { id }, word(key)), body);
}

export function show_devices(main, parameters, signal) {
  const loading = () => element('p', { class: 'quiet' }, word('page.loading'));
  const health = element('div', {}, loading());
  const stations = element('div', { class: 'stations' });
  const store = element('div', {}, loading());
  let figures = new Map();
  main.append(element('h1', {}, word('devices.title')),
    section('health-head', 'devices.health', health),
    section('stations-head', 'live.stations', stations),
    section('store-head', 'devices.store', store));
  follow(['stations', 'age'], signal, () => show_stations(stations, figures));
  const refresh = async () => {
    figures = await show_health(health, store, figures);
  };
  refresh();
  const timer = setInterval(refresh, kPeriodMs);
  signal.addEventListener('abort', () => clearInterval(timer));
}
