// What a scan was checked by, as a table: each value beside its limit, and how the check came out.
import { element } from './elements.js';
import { mark } from './marks.js';
import { format_number } from './numbers.js';
import { item_name } from './sentences.js';
import { word, word_of } from './words.js';

const kMarks = { passed: 'good', warned: 'warning', refused: 'fault' };
// Of what is no dish.
const kTrayLabel = 0;
const kCardLabel = 255;

// The names of checks end in their unit.
function with_unit(text, name) {
  return `${text} ${name.endsWith('_percent') ? '%' : 'mm'}`;
}

// A standard deviation of 0 says that none is known; with a value of 0, that nothing was found to compare.
function has_nothing({ value, sigma }) {
  return value === 0 && sigma === 0;
}

function value_text(check) {
  const { name, value, sigma } = check;
  if (has_nothing(check)) return '–';
  const error = sigma > 0 ? ` ± ${format_number(sigma, 2)}` : '';
  return with_unit(format_number(value, 2) + error, name);
}

// An item's edge may be as high as it likes: only below its dish is it wrong.
function limit_text({ name, limit }) {
  return with_unit(format_number(name === 'item_foot_mm' ? -limit : limit, 2), name);
}

function outcome(check) {
  const verdict = has_nothing(check) ? 'none' : check.verdict;
  return element('span', { class: 'verdict' }, mark(kMarks[verdict] ?? 'away'),
    word_of('verdict', verdict) ?? verdict);
}

function whose_check({ name, label }, scan) {
  const item = scan.items.find((candidate) => candidate.label === label);
  if (name.startsWith('item_')) return item_name(item ?? { label, food: null });
  if (label === kTrayLabel) return word('checks.tray');
  return label === kCardLabel ? word('checks.card') : word('checks.dish', { label });
}

function what_was_checked(check, scan) {
  const whose = whose_check(check, scan);
  return [word_of('check', check.name) ?? check.name, ' ', element('span', { class: 'quiet' }, whose)];
}

function row(check, scan) {
  const cell = (key, attributes, ...content) => element('td', { 'data-head': word(key), ...attributes }, content);
  return element('tr', { 'data-check': check.name },
    element('th', { scope: 'row' }, what_was_checked(check, scan)),
    cell('checks.value', { class: 'number' }, value_text(check)),
    cell('checks.limit', { class: 'number quiet' }, limit_text(check)),
    cell('checks.verdict', {}, outcome(check)));
}

function table(checks, scan) {
  const heads = [['checks.what', null], ['checks.value', 'number'], ['checks.limit', 'number'],
    ['checks.verdict', null]];
  return element('table', { class: 'checks' },
    element('caption', { class: 'unseen' }, word('checks.title')),
    element('thead', {}, element('tr', {}, heads.map(([key, name]) =>
      element('th', { scope: 'col', class: name }, word(key))))),
    element('tbody', {}, checks.map((check) => row(check, scan))));
}

// Null where nothing was checked, as in scans of earlier programs.
export function check_section(scan) {
  const checks = (Array.isArray(scan.checks) ? scan.checks : []).filter((check) => typeof check?.name === 'string');
  if (checks.length === 0) return null;
  return element('section', { class: 'card', 'aria-labelledby': 'checks-head' },
    element('h2', { id: 'checks-head' }, word('checks.title')),
    table(checks, scan),
    element('p', { class: 'quiet note' }, word('checks.note')));
}
