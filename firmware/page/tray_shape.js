// The measured shape of a tray, as the hub tells it, in millimetres of the table: x to the right, y away from
// who stands at the station.
import { get_if_there } from './hub_api.js';

function millimetres(list, count) {
  const heights = new Float32Array(count).fill(NaN);
  for (let i = 0; i < Math.min(count, list?.length ?? 0); i += 1) {
    if (list[i] !== null) heights[i] = list[i] / 10;
  }
  return heights;
}

function read_dish(dish) {
  const count = dish.columns * dish.rows;
  const [left, near] = dish.origin_mm;
  return {
    dish: dish.dish, cell: dish.cell_mm, columns: dish.columns, rows: dish.rows, left, near,
    surface: millimetres(dish.surface_tenth_mm, count),
    inner: millimetres(dish.inner_tenth_mm, count),
    labels: Uint16Array.from({ length: count }, (_, i) => dish.labels?.[i] ?? 0),
  };
}

// The edge of the dish as seen from above: the first and the last known cell of each row.
function edge_of(dish) {
  const left = [];
  const right = [];
  for (let row = 0; row < dish.rows; row += 1) {
    const cells = dish.inner.subarray(row * dish.columns, (row + 1) * dish.columns);
    const first = cells.findIndex((height) => !Number.isNaN(height));
    if (first < 0) continue;
    const last = cells.findLastIndex((height) => !Number.isNaN(height));
    const y = dish.near + row * dish.cell;
    left.push([dish.left + first * dish.cell, y]);
    right.unshift([dish.left + last * dish.cell, y]);
  }
  return smoothed(left.concat(right));
}

// Cells make steps of an edge that is round: each point becomes the mean of its neighbours.
function smoothed(points) {
  const kReach = 3;
  return points.map((_, i) => {
    const near = Array.from({ length: 2 * kReach + 1 }, (__, step) =>
      points.at((i + step - kReach + points.length) % points.length));
    return [0, 1].map((axis) => near.reduce((sum, point) => sum + point[axis], 0) / near.length);
  });
}

function bounds_of(points) {
  const kMarginMm = 8;
  const xs = points.map((point) => point[0]);
  const ys = points.map((point) => point[1]);
  const left = Math.min(...xs) - kMarginMm;
  const near = Math.min(...ys) - kMarginMm;
  return { left, near, width: Math.max(...xs) + kMarginMm - left, depth: Math.max(...ys) + kMarginMm - near };
}

// {dishes, edges, outlines, bounds}; null where the hub keeps no shape of this scan any more.
export async function read_shape(id) {
  const told = await get_if_there(`scans/${encodeURIComponent(id)}/shape`);
  if (told === null || !Array.isArray(told.dishes) || told.dishes.length === 0) return null;
  const dishes = told.dishes.map(read_dish);
  const edges = dishes.map(edge_of);
  const outlines = (told.outlines ?? []).filter((outline) => outline.points_mm?.length > 2);
  const corners = dishes.flatMap((dish) => [[dish.left, dish.near],
    [dish.left + dish.columns * dish.cell, dish.near + dish.rows * dish.cell]]);
  const points = edges.flat().concat(outlines.flatMap((outline) => outline.points_mm));
  return { dishes, edges, outlines, bounds: bounds_of(points.length > 0 ? points : corners) };
}

// The cell below a place of the table: {dish, index}; null beside all dishes.
export function cell_at(shape, x, y) {
  for (const dish of shape.dishes) {
    const column = Math.round((x - dish.left) / dish.cell);
    const row = Math.round((y - dish.near) / dish.cell);
    if (column < 0 || row < 0 || column >= dish.columns || row >= dish.rows) continue;
    const index = row * dish.columns + column;
    if (!Number.isNaN(dish.surface[index]) || !Number.isNaN(dish.inner[index])) return { dish, index };
  }
  return null;
}

export function highest_mm(shape) {
  let highest = 0;
  for (const dish of shape.dishes) {
    for (const height of dish.surface) if (height > highest) highest = height;
  }
  return highest;
}
