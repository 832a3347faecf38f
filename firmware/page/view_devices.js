// Whether everything works: hub, stations, their devices, and what the store holds.
import { element } from './elements.js';
import { error_note } from './error_note.js';
import { get_health, get_metrics } from './hub_api.js';
import { health_list } from './health_parts.js';
import { follow, live } from './live_data.js';
import { fault_lines, station_line } from './station_state.js';
import { state_facts } from './state_facts.js';
import { store_figures } from './store_figures.js';
import { word } from './words.js';

const kPeriodMs = 5000;

function station_card(station) {
  const line = station_line(station);
  line.querySelector('.station-words').append(fault_lines(station) ?? '', state_facts(station));
  return line;
}

function show_stations(frame) {
  const nothing = element('p', { class: 'quiet' }, word('live.no_station'));
  frame.replaceChildren(...(live.stations.length > 0 ? live.stations.map(station_card) : [nothing]));
}

async function show_health(health, figures) {
  try {
    const [told, metrics] = await Promise.all([get_health(), get_metrics()]);
    health.replaceChildren(health_list(told));
    figures.replaceChildren(store_figures(metrics));
  } catch (error) {
    health.replaceChildren(error_note(error));
  }
}

function section(id, key, body) {
  return element('section', { class: 'card', 'aria-labelledby': id }, element('h2', { id }, word(key)), body);
}

export function show_devices(main, parameters, signal) {
  const loading = () => element('p', { class: 'quiet' }, word('page.loading'));
  const health = element('div', {}, loading());
  const stations = element('div', { class: 'stations' });
  const figures = element('div', {}, loading());
  main.append(element('h1', {}, word('devices.title')),
    section('health-head', 'devices.health', health),
    section('stations-head', 'live.stations', stations),
    section('store-head', 'devices.store', figures));
  follow(['stations', 'age'], signal, () => show_stations(stations));
  show_health(health, figures);
  const timer = setInterval(() => show_health(health, figures), kPeriodMs);
  signal.addEventListener('abort', () => clearInterval(timer));
}
