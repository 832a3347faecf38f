// The height map: how high everything stands above the table, seen from above.
import { element } from './elements.js';
import { is_lit, item_of_label } from './item_colours.js';
import { format_number } from './numbers.js';
import { item_name } from './sentences.js';
import { cell_at, highest_mm } from './tray_shape.js';
import { word } from './words.js';

// From low to high; equal steps of the height look like equal steps of the colour.
const kRamp = [[246, 241, 225], [206, 224, 192], [124, 189, 163], [43, 138, 128], [10, 72, 86]];
const kPixelsPerCell = 4;

function ramp_colour(share) {
  const place = Math.min(Math.max(share, 0), 1) * (kRamp.length - 1);
  const step = Math.min(Math.floor(place), kRamp.length - 2);
  return kRamp[step].map((low, i) => low + (kRamp[step + 1][i] - low) * (place - step));
}

function height_of(dish, index) {
  return Number.isNaN(dish.surface[index]) ? dish.inner[index] : dish.surface[index];
}

// Slopes that face the upper left are lighter, as if a lamp stood there.
function shade_of(dish, column, row, height) {
  const at = (c, r) => {
    const inside = c >= 0 && r >= 0 && c < dish.columns && r < dish.rows;
    const value = inside ? height_of(dish, r * dish.columns + c) : NaN;
    return Number.isNaN(value) ? height : value;
  };
  const slope = (at(column + 1, row) - at(column - 1, row)) - (at(column, row + 1) - at(column, row - 1));
  return Math.min(Math.max(1 + slope / (dish.cell * 14), 0.75), 1.15);
}

// One pixel a cell, the far side on top.
function cells_picture(dish, highest, lit) {
  const picture = new ImageData(dish.columns, dish.rows);
  for (let row = 0; row < dish.rows; row += 1) {
    for (let column = 0; column < dish.columns; column += 1) {
      const index = row * dish.columns + column;
      const height = height_of(dish, index);
      if (Number.isNaN(height)) continue;
      const shade = shade_of(dish, column, row, height) * (lit !== null && !lit(dish.labels[index]) ? 0.7 : 1);
      const target = ((dish.rows - 1 - row) * dish.columns + column) * 4;
      ramp_colour(height / highest).forEach((value, i) => { picture.data[target + i] = value * shade; });
      picture.data[target + 3] = 255;
    }
  }
  const canvas = element('canvas', { width: dish.columns, height: dish.rows });
  canvas.getContext('2d').putImageData(picture, 0, 0);
  return canvas;
}

function draw(canvas, shape, highest, lit) {
  const { bounds } = shape;
  const scale = canvas.width / bounds.width;
  const context = canvas.getContext('2d');
  context.clearRect(0, 0, canvas.width, canvas.height);
  for (const dish of shape.dishes) {
    const far = dish.near + (dish.rows - 0.5) * dish.cell;
    context.drawImage(cells_picture(dish, highest, lit), (dish.left - dish.cell / 2 - bounds.left) * scale,
      (bounds.near + bounds.depth - far) * scale, dish.columns * dish.cell * scale, dish.rows * dish.cell * scale);
  }
}

function place_of(event, canvas, bounds) {
  const box = canvas.getBoundingClientRect();
  return [bounds.left + ((event.clientX - box.left) / box.width) * bounds.width,
    bounds.near + bounds.depth - ((event.clientY - box.top) / box.height) * bounds.depth];
}

function scale_of(highest) {
  const bar = element('canvas', { class: 'ramp', width: 128, height: 1, 'aria-hidden': 'true' });
  const context = bar.getContext('2d');
  for (let x = 0; x < 128; x += 1) {
    context.fillStyle = `rgb(${ramp_colour(x / 127).map(Math.round).join(',')})`;
    context.fillRect(x, 0, 1, 1);
  }
  return element('div', { class: 'height-scale' }, element('span', {}, word('tray.table')), bar,
    element('span', {}, word('tray.millimetres', { height: format_number(highest) })));
}

export function show_heights(shape, scan, selection, signal) {
  const { bounds } = shape;
  const highest = Math.max(highest_mm(shape), 1);
  const cell = shape.dishes[0].cell;
  const canvas = element('canvas', {
    class: 'heights', role: 'img', width: Math.round((bounds.width / cell) * kPixelsPerCell),
    height: Math.round((bounds.depth / cell) * kPixelsPerCell),
    'aria-label': word('tray.heights_label', { height: format_number(highest) }),
  });
  const told = element('p', { class: 'quiet told' }, word('tray.heights_hint'));
  canvas.addEventListener('pointermove', (event) => {
    const found = cell_at(shape, ...place_of(event, canvas, bounds));
    const item = found === null ? null : item_of_label(found.dish.labels[found.index], scan);
    selection.point(item?.label ?? null);
    const height = found === null ? NaN : height_of(found.dish, found.index);
    const name = item === null ? word('tray.dish') : item_name(item);
    told.textContent = Number.isNaN(height) ? word('tray.heights_hint')
      : word('tray.height_here', { name, height: format_number(height) });
  });
  canvas.addEventListener('pointerleave', () => selection.point(null));
  const redraw = () => {
    const { label } = selection;
    draw(canvas, shape, highest, label === null ? null : (of_cell) => is_lit(of_cell, label, scan));
  };
  selection.addEventListener('change', redraw, { signal });
  redraw();
  return element('div', { class: 'height-map' }, canvas, scale_of(highest), told);
}
