// The hub's figures, of which the store's are shown. They come in Prometheus' text format.
import { element } from './elements.js';
import { format_age, format_bytes, format_number } from './numbers.js';
import { word } from './words.js';

const kWrittenPerScan = 'written_per_scan'; // computed here

const kShown = [
  ['traygauge_stored_scans', 'store.scans', format_number],
  ['traygauge_superseded_scans', 'store.superseded', format_number],
  ['traygauge_corrected_scans', 'store.corrected', format_number],
  ['traygauge_wrong_scans', 'store.wrong', format_number],
  ['traygauge_set_aside_documents', 'store.set_aside', format_number],
  ['traygauge_store_bytes', 'store.bytes', format_bytes],
  ['traygauge_store_written_bytes_total', 'store.written', format_bytes],
  [kWrittenPerScan, 'store.written_per_scan', format_bytes],
  ['traygauge_hub_up_seconds', 'store.up', format_age],
];

// What a scan costs the memory card, on average since the hub started.
function written_per_scan(figures) {
  const stored = figures.get('traygauge_store_new_scans_total');
  return stored > 0 ? figures.get('traygauge_store_written_bytes_total') / stored : undefined;
}

export function read_figures(text) {
  const lines = text.split('\n').filter((line) => line !== '' && !line.startsWith('#'));
  return new Map(lines.map((line) => line.split(' ')).map(([name, value]) => [name, Number(value)]));
}

export function store_figures(told) {
  const figures = new Map(told);
  const per_scan = written_per_scan(figures);
  if (per_scan !== undefined) figures.set(kWrittenPerScan, per_scan);
  const shown = kShown.filter(([name]) => figures.has(name));
  return element('dl', { class: 'facts figures-of-store' }, shown.map(([name, key, format]) =>
    element('div', {}, element('dt', {}, word(key)), element('dd', {}, format(figures.get(name))))));
}
