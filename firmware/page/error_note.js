// Why something could not be done, for people.
import { element, hub_text } from './elements.js';
import { mark } from './marks.js';
import { word, word_of } from './words.js';

export function error_note(error) {
  const known = word_of('error', error.code);
  const text = known ?? (error.status === 0 ? word('error.silent') : word('error.other'));
  const details = error.message && known === null ? [' ', hub_text(error.message)] : [];
  return element('div', { class: 'notice notice-fault', role: 'alert' }, mark('fault'),
    element('p', {}, text, details));
}
