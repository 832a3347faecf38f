// All scans, newest first, with filters. Filters and page stand in the address: going back works.
import { element, new_id } from './elements.js';
import { get } from './hub_api.js';
import { live } from './live_data.js';
import { error_note } from './error_note.js';
import { format_measured, format_volume } from './numbers.js';
import { is_refused, item_name, scan_address, status_text } from './sentences.js';
import { is_zone_of_site, format_time, start_of_day, time_zone } from './times.js';
import { word } from './words.js';

const kDays = { from: 0, to: 1 };  // "to" is a day that still counts, the API's `to` a time that does not
const kTexts = ['station', 'food', 'text'];
const kTruths = ['corrected', 'wrong'];
const kMostItems = 3;  // of a line

function api_filter(chosen) {
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

function filter_form(chosen) {
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

function items_text(scan) {
  const texts = scan.items.slice(0, kMostItems).map((item) =>
    `${item_name(item)} ${format_measured(item.volume_ml, item.sigma_ml)}`);
  const more = scan.items.length - texts.length;
  if (more > 0) texts.push(word('history.more', { count: more }));
  return texts.join(', ');
}

function tags(scan) {
  const told = [['is_corrected', 'tag.corrected'], ['is_wrong', 'tag.wrong'], ['superseded_by', 'tag.superseded']];
  const list = told.filter(([key]) => scan[key]).map(([, key]) => element('span', { class: 'tag' }, word(key)));
  if (scan.clock_synchronised === false) list.push(element('span', { class: 'tag' }, word('tag.clock')));
  return list;
}

function row(scan) {
  const what = is_refused(scan) ? [element('strong', {}, word('scan.refused')), ' ', status_text(scan)]
    : items_text(scan);
  const cell = (key, attributes, ...content) => element('td', { 'data-head': word(key), ...attributes }, content);
  return element('tr', {},
    element('th', { scope: 'row' }, element('a', { href: scan_address(scan.id) }, format_time(scan.taken_at, 'short'))),
    cell('history.station', { class: 'quiet' }, scan.station),
    cell('history.items', {}, what),
    cell('scan.total', { class: 'number' }, is_refused(scan) ? '–' : format_volume(scan.volume_ml)),
    cell('history.remarks', { class: 'tags' }, tags(scan)));
}

function table(scans) {
  const heads = ['history.time', 'history.station', 'history.items', 'scan.total', 'history.remarks'];
  return element('table', { class: 'history' },
    element('caption', { class: 'unseen' }, word('history.title')),
    element('thead', {}, element('tr', {}, heads.map((key) =>
      element('th', { scope: 'col', class: key === 'scan.total' ? 'number' : null }, word(key))))),
    element('tbody', {}, scans.map(row)));
}

// A page may be empty though others follow: the hub looks at a bounded number of scans a call.
async function read_page(filter, cursor) {
  const kMostCalls = 10;
  let next = cursor;
  for (let call = 0; call < kMostCalls; call += 1) {
    const query = new URLSearchParams(filter);
    query.set('limit', 25);
    if (next) query.set('cursor', next);
    const page = await get(`scans?${query}`);
    if (page.scans.length > 0 || page.next === null) return page;
    next = page.next;
  }
  return { scans: [], next };
}

function paging(chosen, next) {
  const address = (cursor) => {
    const query = new URLSearchParams(chosen);
    query.delete('cursor');
    if (cursor) query.set('cursor', cursor);
    return `#history?${query}`;
  };
  return element('nav', { class: 'paging', 'aria-label': word('history.pages') },
    chosen.get('cursor') ? element('a', { class: 'button', href: address(null) }, word('history.newest')) : null,
    next ? element('a', { class: 'button', href: address(next) }, word('history.older')) : null);
}

export function show_history(main, { query }, signal) {
  const filter = api_filter(query);
  const found = element('div', { class: 'card found' }, element('p', { class: 'quiet' }, word('page.loading')));
  const zone = word(is_zone_of_site() ? 'time.zone_of_site' : 'time.zone_of_browser', { zone: time_zone() });
  main.append(
    element('div', { class: 'title-line' }, element('h1', {}, word('history.title')),
      element('a', { class: 'button', href: `api/v1/export.csv?${filter}`, download: 'traygauge.csv' },
        word('history.csv'))),
    filter_form(query), found, element('p', { class: 'quiet note' }, zone));
  read_page(filter, query.get('cursor')).then(({ scans, next }) => {
    if (signal.aborted) return;
    const nothing = element('p', { class: 'quiet' }, word('history.nothing'));
    found.replaceChildren(scans.length > 0 ? table(scans) : nothing, paging(query, next));
  }).catch((error) => found.replaceChildren(error_note(error)));
}
