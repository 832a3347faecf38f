// Dishes and items as seen from above.
import { drawing } from './elements.js';
import { is_lit, item_number, item_of_label } from './item_colours.js';
import { item_sentence } from './sentences.js';
import { word } from './words.js';

// On the screen y goes down, on the table away.
function path_of(points, bounds) {
  const far = bounds.near + bounds.depth;
  const places = points.map(([x, y]) => `${(x - bounds.left).toFixed(1)} ${(far - y).toFixed(1)}`);
  return `M${places.join('L')}Z`;
}

function signed_area(points) {
  return points.reduce((sum, [x, y], i) => {
    const [next_x, next_y] = points[(i + 1) % points.length];
    return sum + (x * next_y - next_x * y) / 2;
  }, 0);
}

function centre_of(points, bounds) {
  const mean = (axis) => points.reduce((sum, point) => sum + point[axis], 0) / points.length;
  return [mean(0) - bounds.left, bounds.near + bounds.depth - mean(1)];
}

// All polygons of a label are one item, with one number in the largest.
function item_group(label, outlines, shape, scan, selection) {
  const item = item_of_label(label, scan);
  const d = outlines.map((outline) => path_of(outline.points_mm, shape.bounds)).join('');
  const size = (outline) => Math.abs(signed_area(outline.points_mm));
  const largest = outlines.reduce((best, outline) => (size(outline) > size(best) ? outline : best));
  const [x, y] = centre_of(largest.points_mm, shape.bounds);
  const colour = item === null ? 'none' : item_number(item, scan) % 8;
  return drawing('g', {
    class: `outline outline-${colour}`, 'data-outline': label,
    on: item === null ? {} : {
      pointerenter: () => selection.point(item.label),
      pointerleave: () => selection.point(null),
      click: () => selection.pin(item.label),
    },
  }, drawing('path', { d, 'fill-rule': 'evenodd' }),
  drawing('circle', { cx: x, cy: y, r: 8 }),
  drawing('text', { x, y, class: 'outline-number' }, String(item?.label ?? label)));
}

function groups_of(outlines) {
  const groups = new Map();
  for (const outline of outlines) groups.set(outline.label, [...(groups.get(outline.label) ?? []), outline]);
  return groups;
}

export function show_outlines(shape, scan, selection, signal) {
  const { bounds } = shape;
  const dishes = shape.edges.map((edge) => drawing('path', { class: 'dish', d: path_of(edge, bounds) }));
  const items = [...groups_of(shape.outlines)].map(([label, outlines]) =>
    item_group(label, outlines, shape, scan, selection));
  const picture = drawing('svg', {
    class: 'outlines', viewBox: `0 0 ${bounds.width} ${bounds.depth}`, role: 'img',
    'aria-label': word('tray.outlines_label', { items: scan.items.map(item_sentence).join('; ') }),
  }, dishes, items);
  const light_up = () => {
    for (const group of picture.querySelectorAll('[data-outline]')) {
      group.classList.toggle('is-lit', is_lit(Number(group.dataset.outline), selection.label, scan));
    }
  };
  selection.addEventListener('change', light_up, { signal });
  light_up();
  return picture;
}
