// Who corrected what of a scan, when and why.
import { element } from './elements.js';
import { format_volume } from './numbers.js';
import { format_time } from './times.js';
import { word } from './words.js';

export function correction_text(correction) {
  const { action, item, food, others, volume_ml: volume, number } = correction;
  switch (action) {
    case 'rename': return word('correction.did_rename', { item, food });
    case 'merge': return word('correction.did_merge', { item, others: others.join(', ') });
    case 'split': return word('correction.did_split', {
      item, volume: format_volume(volume), food: food || word('item.without_name'),
    });
    case 'item_wrong': return word('correction.did_item_wrong', { item });
    case 'scan_wrong': return word('correction.did_scan_wrong');
    case 'undo': return word('correction.did_undo', { number });
    default: return action;
  }
}

// The one that can be taken back: the last that still holds. Null where none does.
export function last_holding(corrections) {
  const holding = [];
  for (const correction of corrections) {
    if (correction.action === 'undo') {
      const at = holding.findIndex((earlier) => earlier.correction === correction.number);
      if (at >= 0) holding.splice(at, 1);
    } else {
      holding.push(correction);
    }
  }
  return holding.at(-1) ?? null;
}

export function correction_list(corrections) {
  if (corrections.length === 0) return element('p', { class: 'quiet no-corrections' }, word('correction.none'));
  return element('ol', { class: 'corrections' }, corrections.map((correction) =>
    element('li', { value: correction.correction },
      element('p', {}, correction_text(correction)),
      element('p', { class: 'quiet' },
        word('correction.by', { author: correction.author, time: format_time(correction.made_at) }),
        correction.reason ? ` – ${correction.reason}` : ''))));
}
