// The items of a scan as a table; what was measured stands beside what was corrected.
import { element } from './elements.js';
import { format_measured, format_volume } from './numbers.js';
import { item_name, why_no_volume } from './sentences.js';
import { item_number } from './item_colours.js';
import { word } from './words.js';

function marker(item, scan) {
  return element('span', { class: `swatch swatch-${item_number(item, scan) % 8}`, 'aria-hidden': 'true' },
    String(item.label));
}

function name_button(item, scan, selection) {
  return element('button', {
    type: 'button', class: 'item-name', 'aria-pressed': 'false', 'data-label': item.label,
    on: {
      focus: () => selection.point(item.label),
      blur: () => selection.point(null),
      click: () => selection.pin(item.label),
    },
  }, marker(item, scan), element('span', {}, item_name(item)));
}

function volume_cell(item) {
  if (item.volume_ml === null) return element('span', { class: 'no-volume' }, why_no_volume(item));
  const text = format_measured(item.volume_ml, item.sigma_ml);
  return item.is_wrong ? [element('s', {}, text), ' ', element('span', { class: 'tag' }, word('item.wrong'))] : text;
}

// The measured volume, and the measured name where a person gave another one.
function measured_cell(item) {
  if (item.split_from !== null) return word('item.split_from', { label: item.split_from });
  const volume = item.measured_volume_ml === null ? word('item.no_volume')
    : format_measured(item.measured_volume_ml, item.measured_sigma_ml);
  const is_renamed = item.measured_food !== null && item.measured_food !== item.food;
  const name = is_renamed ? `${item.measured_food}, ` : '';
  const merged = item.merged.length > 0 ? ` ${word('item.merged', { labels: item.merged.join(', ') })}` : '';
  return name + volume + merged;
}

function row(item, scan, columns, selection) {
  const cells = columns.map((column) =>
    element('td', { class: column.class, 'data-head': word(column.head) }, column.cell(item)));
  return element('tr', {
    'data-label': item.label, class: item.is_wrong ? 'is-wrong' : '',
    on: { pointerenter: () => selection.point(item.label), pointerleave: () => selection.point(null) },
  }, element('th', { scope: 'row' }, name_button(item, scan, selection)), cells);
}

function columns_of(scan) {
  const columns = [{ head: 'item.volume', class: 'number', cell: volume_cell }];
  if (scan.is_corrected) columns.push({ head: 'item.measured', class: 'number quiet', cell: measured_cell });
  const has_dishes = new Set(scan.items.map((item) => item.dish)).size > 1;
  if (has_dishes) columns.push({ head: 'item.dish', class: 'number quiet', cell: (item) => String(item.dish) });
  return columns;
}

function light_up(table, selection) {
  for (const line of table.querySelectorAll('tr[data-label]')) {
    const label = Number(line.dataset.label);
    line.classList.toggle('is-lit', label === selection.label);
    line.querySelector('button').setAttribute('aria-pressed', String(label === selection.pinned));
  }
}

export function item_table(scan, selection) {
  const columns = columns_of(scan);
  const heads = columns.map((column) => element('th', { scope: 'col', class: column.class }, word(column.head)));
  const table = element('table', { class: columns.length > 1 ? 'items is-wide' : 'items' },
    element('caption', { class: 'unseen' }, word('item.caption', { scan: scan.id })),
    element('thead', {}, element('tr', {}, element('th', { scope: 'col' }, word('item.food')), heads)),
    element('tbody', {}, scan.items.map((item) => row(item, scan, columns, selection))));
  selection.addEventListener('change', () => light_up(table, selection));
  return table;
}

export function total_line(scan) {
  return element('p', { class: 'total' },
    element('span', { class: 'total-number' }, format_volume(scan.volume_ml)),
    element('span', { class: 'quiet' }, word('scan.total')));
}
