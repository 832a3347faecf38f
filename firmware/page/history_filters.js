// The filters of the history: fields for people, parameters for the API.
import { element, new_id } from './elements.js';
import { live } from './live_data.js';
import { start_of_day } from './times.js';
import { word } from './words.js';

const kDays = { from: 0, to: 1 };  // "to" is a day that still counts, the API's `to` a time that does not
const kTexts = ['station', 'food', 'text'];
const kTruths = ['corrected', 'wrong'];

// `chosen`: what stands in the page's address.
export function api_filter(chosen) {
  const filter = new URLSearchParams();
  for (const [name, days] of Object.entries(kDays)) {
    if (/^\d{4}-\d{2}-\d{2}$/.test(chosen.get(name) ?? '')) filter.set(name, start_of_day(chosen.get(name), days));
  }
  for (const name of [...kTexts, ...kTruths]) if (chosen.get(name)) filter.set(name, chosen.get(name));
  return filter;
}

function labelled(key, field) {
  field.id = new_id('field');
  return element('div', { class: 'field' }, element('label', { for: field.id }, word(key)), field);
}

function truth_field(name, value, keys) {
  const options = ['', 'true', 'false'].map((option, i) =>
    element('option', { value: option, selected: option === value }, word(keys[i])));
  return element('select', { name }, options);
}

function station_names() {
  const id = new_id('stations');
  const options = live.stations.map((station) => element('option', { value: station.name }));
  return element('datalist', { id }, options);
}

export function filter_form(chosen) {
  const value = (name) => chosen.get(name) ?? '';
  const text = (name, attributes = {}) => element('input', { name, type: 'search', value: value(name), ...attributes });
  const day = (name) => element('input', { name, type: 'date', value: value(name) });
  const names = station_names();
  const form = element('form', { class: 'filters card', role: 'search', 'aria-label': word('history.filters') },
    labelled('history.from', day('from')), labelled('history.to', day('to')),
    labelled('history.station', text('station', { list: names.id })), names,
    labelled('history.food', text('food')), labelled('history.text', text('text')),
    labelled('history.corrected', truth_field('corrected', value('corrected'),
      ['history.any', 'history.corrected_only', 'history.uncorrected_only'])),
    labelled('history.wrong', truth_field('wrong', value('wrong'),
      ['history.any', 'history.wrong_only', 'history.right_only'])),
    element('div', { class: 'field actions' },
      element('button', { type: 'submit', class: 'main-button' }, word('history.search')),
      element('a', { href: '#history', class: 'button' }, word('history.reset'))));
  form.addEventListener('submit', (event) => {
    event.preventDefault();
    const wanted = [...new FormData(form)].filter(([, entry]) => entry !== '');
    location.hash = `#history?${new URLSearchParams(wanted)}`;
  });
  return form;
}
