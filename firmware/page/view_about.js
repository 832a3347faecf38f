// What this program is.
import { element } from './elements.js';
import { live } from './live_data.js';
import { session } from './session.js';
import { site } from './site.js';
import { is_zone_of_site, time_zone } from './times.js';
import { word, word_of } from './words.js';

function versions() {
  const told = live.stations.filter((station) => station.program);
  const lines = told.map((station) => [word('about.station', { name: station.name }), station.program]);
  if (site.program) lines.unshift([word('about.hub'), site.program]);
  return lines.length > 0 ? lines : [[word('about.version'), word('about.untold')]];
}

export function show_about(main) {
  const zone = `${time_zone()} (${word(is_zone_of_site() ? 'about.zone_site' : 'about.zone_browser')})`;
  const role = word_of('role', session.role) ?? '–';
  const lines = [...versions(), [word('about.role'), role], [word('about.zone'), zone],
    [word('about.licence'), 'Apache-2.0']];
  main.append(element('h1', {}, word('about.title')),
    element('div', { class: 'card prose' },
      element('p', {}, word('about.what')),
      element('p', {}, word('about.sigma')),
      element('dl', { class: 'facts' }, lines.map(([name, value]) =>
        element('div', {}, element('dt', {}, name), element('dd', {}, value))))));
}
