// What codes of the hub mean, as sentences in the page's language.
import { element, hub_text } from './elements.js';
import { word, word_of } from './words.js';
import { format_measured } from './numbers.js';

export function item_name(item) {
  return item.food ?? word('item.nameless', { label: item.label });
}

// "Rice 142 ml ± 5 ml", or why there is no volume.
export function item_sentence(item) {
  const volume = item.volume_ml === null ? why_no_volume(item) : format_measured(item.volume_ml, item.sigma_ml);
  return `${item_name(item)} ${volume}`;
}

export function why_no_volume(item) {
  return word_of('status', item.status) ?? word('item.unmeasured', { status: item.status });
}

// A status that the page has no words for comes with the hub's own sentence.
export function status_text(scan) {
  const known = word_of('status', scan.status);
  if (known !== null) return element('span', {}, known);
  return scan.message ? hub_text(scan.message) : element('span', {}, scan.status);
}

// Refused, or a device failed: no volume at all.
export function is_refused(scan) {
  return scan.status !== 'ok' && scan.status !== 'partial';
}

function warning_text(warning, scan) {
  const known = word_of('warning', warning.code);
  const text = known === null ? hub_text(warning.message ?? warning.code) : element('span', {}, known);
  const item = scan.items.find((candidate) => candidate.label === warning.label);
  return item ? [`${item_name(item)}: `, text] : [text];
}

export function warning_list(scan) {
  const warnings = Array.isArray(scan.warnings) ? scan.warnings : [];
  if (warnings.length === 0) return null;
  const lines = warnings.map((warning) => element('li', {}, warning_text(warning, scan)));
  return element('div', { class: 'warnings' },
    element('h3', {}, word('scan.warnings')), element('ul', {}, lines));
}

// A link to another scan inside of a sentence: the key's {scan} becomes the link.
export function sentence_with_scan(key, id) {
  const [before, after] = word(key).split('{scan}');
  return [before, element('a', { href: scan_address(id) }, id), after ?? ''];
}

export function scan_address(id) {
  return `#scan/${encodeURIComponent(id)}`;
}
