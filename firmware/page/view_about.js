// What this program is.
import { element } from './elements.js';
import { live } from './live_data.js';
import { site } from './site.js';
import { is_zone_of_site, time_zone } from './times.js';
import { word } from './words.js';

function versions() {
  const told = live.stations.filter((station) => station.program);
  const lines = told.map((station) => [word('about.station', { name: station.name }), station.program]);
  if (site.program) lines.unshift([word('about.hub'), site.program]);
  return lines.length > 0 ? lines : [[word('about.version'), word('about.untold')]];
}

export function show_about(main) {
  const zone = `${time_zone()} (${word(is_zone_of_site() ? 'about.zone_site' : 'about.zone_browser')})`;
  const lines = [...versions(), [word('about.zone'), zone], [word('about.licence'), 'Apache-2.0']];
  main.append(element('h1', {}, word('about.title')),
    element('section', { class: 'card prose' },
      element('p', {}, word('about.what')),
      element('p', {}, word('about.sigma')),
      element('dl', { class: 'facts' }, lines.map(([name, value]) =>
        element('div', {}, element('dt', {}, name), element('dd', {}, value))))));
}
