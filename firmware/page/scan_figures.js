// A scan's result in words and numbers: what is doubtful first, then the total, then each item.
import { element } from './elements.js';
import { item_table, total_line } from './item_table.js';
import { scan_notices } from './scan_head.js';
import { is_refused, warning_list } from './sentences.js';
import { word } from './words.js';

function scan_figures(scan, selection) {
  const has_items = scan.items.length > 0;
  return element('div', { class: 'figures' }, scan_notices(scan),
    is_refused(scan) && !has_items ? null : total_line(scan),
    has_items ? item_table(scan, selection) : null,
    has_items ? element('p', { class: 'quiet note' }, word('item.sigma_note')) : null,
    warning_list(scan));
}

// The result, and beside it what is drawn of the tray.
export function scan_body(scan, selection, ...drawings) {
  const has_drawings = scan.items.length > 0;
  return element('div', { class: has_drawings ? 'scan-body' : 'scan-body is-alone' },
    scan_figures(scan, selection), element('div', {}, drawings));
}
