// Whether a station drifts, in figures: medians of its last trays, out of the hub's figures.
import { element } from './elements.js';
import { format_number } from './numbers.js';
import { word, word_of } from './words.js';

const kChecks = [['scale_percent', '%'], ['dish_height_mm', 'mm'], ['glaze_height_mm', 'mm'], ['blur_px', 'px']];

// Null before the first tray that has one of them.
export function drift_figures(figures, station) {
  const lines = kChecks.flatMap(([check, unit]) => {
    const figure = (name) => figures.get(`traygauge_check_${name}{station="${station}",check="${check}"}`);
    const [median, error, count] = ['median', 'median_error', 'scans'].map(figure);
    if (!(count > 0)) return [];
    const title = word('drift.of', { what: word_of('drift', check), count: format_number(count) });
    const value = `${format_number(median, 2)} ± ${format_number(error, 2)}\u00a0${unit}`;
    return [element('div', {}, element('dt', {}, title), element('dd', {}, value))];
  });
  return lines.length > 0 ? element('dl', { class: 'facts drift' }, lines) : null;
}
