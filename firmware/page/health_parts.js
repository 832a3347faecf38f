// The parts of the hub's /health in plain words.
import { element, hub_text } from './elements.js';
import { mark } from './marks.js';
import { kind_of_device } from './station_devices.js';
import { language, word, word_of } from './words.js';

const kMarks = { ok: 'good', warning: 'warning', failing: 'fault' };

// The hub's own parts have the names of a station's parts, but no station.
const kHubParts = { disk: 'hub_disk', configuration: 'hub_configuration' };

// The hub's names: "disk", "clock", "station NAME", "disk of NAME", "queue of NAME", "drift of NAME", "lens of NAME",
// "DEVICE of NAME", where a device is such as "camera /dev/video0".
function split_name(name) {
  if (name.startsWith('station ')) return { kind: 'station', station: name.slice('station '.length) };
  const at = name.lastIndexOf(' of ');
  if (at < 0) return { kind: kHubParts[name] ?? name, station: '' };
  const what = name.slice(0, at);
  return { kind: kind_of_device(what) ?? what, station: name.slice(at + ' of '.length) };
}

function title_of(name) {
  const { kind, station } = split_name(name);
  if (word_of('health', kind) !== null) return word_of('health', kind, { station });
  return station === '' ? name : word('health.device', { device: kind, station });
}

// The hub's own sentence says more, in English; beside it stands ours.
function sentence_of(part) {
  const { kind } = split_name(part.name);
  if (part.status === 'ok') return word('health.ok');
  const ours = word_of('health_bad', kind);
  if (ours === null || language === 'en') return part.message ? hub_text(part.message) : word('health.bad');
  // What drifts, by how much, and where the dirt is stands in the hub's sentence alone.
  return (kind === 'drift' || kind === 'lens') && part.message ? [ours, ' ', hub_text(`(${part.message})`)] : ours;
}

function line(part) {
  return element('li', { class: `health health-${part.status}` }, mark(kMarks[part.status] ?? 'warning'),
    element('div', {}, element('strong', {}, title_of(part.name)), element('p', {}, sentence_of(part))));
}

export function health_list(health) {
  const worst = word_of('health_all', health.status) ?? health.status;
  return element('div', {}, element('p', { class: 'health-all' }, worst),
    element('ul', { class: 'health-parts' }, health.parts.map(line)));
}
