// The band that says in words whether what is shown is live. Old data is greyed on the whole page.
import { element } from './elements.js';
import { live } from './live_data.js';
import { mark } from './marks.js';
import { format_age } from './numbers.js';
import { format_time } from './times.js';
import { word } from './words.js';

function describe() {
  if (live.needs_login) return { kind: 'away', text: word('connection.login') };
  if (live.answered_at === null && live.silent_since === null) return { kind: 'busy', text: word('page.loading') };
  if (live.silent_since !== null && !live.is_fresh()) {
    return { kind: 'fault', text: word('connection.lost', { time: format_time(live.silent_since, 'clock') }) };
  }
  if (!live.is_fresh()) return { kind: 'warning', text: word('connection.late', { age: format_age(live.age()) }) };
  if (live.store_problem !== null) return { kind: 'fault', text: word('error.store') };
  return { kind: 'good', text: word('connection.live', { age: format_age(live.age()) }) };
}

export function show_connection(band) {
  let told = '';
  live.addEventListener('age', () => {
    const { kind, text } = describe();
    document.body.classList.toggle('is-stale', kind === 'fault' || kind === 'warning');
    document.body.dataset.connection = kind;
    if (text === told) return;
    told = text;
    band.replaceChildren(mark(kind), element('span', {}, text));
    band.className = `connection connection-${kind}`;
  });
}

// Loss and return are read aloud once; the seconds are not.
export function announce_connection(announce) {
  let was_fresh = true;
  live.addEventListener('age', () => {
    const is_fresh = live.is_fresh() || live.answered_at === null;
    if (is_fresh !== was_fresh) announce(word(is_fresh ? 'connection.back' : 'connection.gone'));
    was_fresh = is_fresh;
  });
}
