// What is left to do before the first tray, where nothing has been measured yet.
import { element } from './elements.js';
import { get_if_there } from './hub_api.js';
import { live } from './live_data.js';
import { mark } from './marks.js';
import { word, word_of } from './words.js';

const kAskAgainMs = 3000;  // somebody is at the terminal meanwhile
const kCommand = 'sudo traygauge setup /etc/traygauge/station.toml';

function steps(setup) {
  return [['card', setup.card], ['lens', setup.lens], ['arm', setup.arm], ['station', live.stations.length > 0],
    ['tray', false]];
}

function step_line([name, is_done]) {
  return element('li', { class: is_done ? 'is-done' : null }, mark(is_done ? 'good' : 'away'),
    element('span', {}, `${word(is_done ? 'setup.done' : 'setup.open')} `, word_of('setup', name)));
}

function fill(frame, setup) {
  frame.replaceChildren(
    element('h2', {}, word('setup.title')),
    element('ol', { class: 'first-steps' }, steps(setup).map(step_line)),
    element('p', {}, word('setup.how'), ' ', element('code', {}, kCommand)));
}

// Fills the frame as long as it is shown; a hub without a station file knows of no steps, and leaves it as it is.
export function show_first_steps(frame) {
  let timer = null;
  let is_closed = false;
  const look = async () => {
    const told = await get_if_there('site').catch(() => null);
    if (is_closed) return;
    if (told?.setup) fill(frame, told.setup);
    timer = setTimeout(look, kAskAgainMs);
  };
  look();
  return () => {
    is_closed = true;
    clearTimeout(timer);
  };
}
