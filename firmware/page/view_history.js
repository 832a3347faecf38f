// All scans, newest first, with filters. Filters and page stand in the address: going back works.
import { element } from './elements.js';
import { get } from './hub_api.js';
import { error_note } from './error_note.js';
import { api_filter, filter_form } from './history_filters.js';
import { format_measured, format_volume } from './numbers.js';
import { is_refused, item_name, scan_address, status_text } from './sentences.js';
import { format_time, is_zone_of_site, time_zone } from './times.js';
import { word } from './words.js';

const kMostItems = 3;  // of a line

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
    cell('history.station', { class: 'quiet name' }, scan.station),
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
