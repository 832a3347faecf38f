// What a station tells of itself beside its state, in words. Keys that this page does not know are shown as
// they are, so that nothing a station says is hidden.
import { element } from './elements.js';
import { format_bytes, format_number } from './numbers.js';
import { format_time, format_written_day } from './times.js';
import { word, word_of } from './words.js';

const kShownElsewhere = ['state', 'faults', 'disk', 'configuration', 'devices', 'next_tray'];
const kMostText = 200;

function is_day(value) {
  return typeof value === 'string' && /^\d{4}-\d\d-\d\d$/.test(value) && !Number.isNaN(Date.parse(value));
}

function value_text(key, value) {
  if (Array.isArray(value)) return value.join(', ').slice(0, kMostText);
  if (typeof value === 'boolean') return word(value ? 'fact.yes' : 'fact.no');
  if (typeof value === 'number') {
    if (key.endsWith('_c')) return `${format_number(value, 1)} °C`;
    if (key.endsWith('_bytes')) return format_bytes(value);
    if (key.endsWith('_percent')) return `${format_number(value, 2)} %`;
    if (key.endsWith('_mm')) return `${format_number(value, 2)} mm`;
    if (key.endsWith('_s')) return word('number.seconds', { count: format_number(value) });
    return format_number(value, Number.isInteger(value) ? 0 : 2);
  }
  if (typeof value === 'string' && /^\d{4}-\d\d-\d\dT/.test(value)) return format_time(value);
  if (is_day(value)) return format_written_day(value);
  return (typeof value === 'string' ? value : JSON.stringify(value)).slice(0, kMostText);
}

// {"calibration": {"grade": 0.2}} is told as "calibration.grade".
function flat(state, prefix = '') {
  const own = Object.entries(state).filter(([key]) => !kShownElsewhere.includes(key));
  return own.flatMap(([key, value]) => {
    const is_group = value !== null && typeof value === 'object' && !Array.isArray(value);
    return is_group && prefix === '' ? flat(value, `${key}.`) : [[prefix + key, value]];
  });
}

export function state_facts(station) {
  const facts = flat(station.state ?? {}).filter(([, value]) => value !== null && value?.length !== 0);
  if (station.program) facts.push(['program', station.program]);
  return element('dl', { class: 'facts' }, facts.map(([key, value]) => element('div', {},
    element('dt', {}, word_of('fact', key) ?? key), element('dd', {}, value_text(key, value)))));
}
