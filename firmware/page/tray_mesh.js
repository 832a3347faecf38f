// The tray's upper surface as triangles for the 3-D library.
import { colour_of_label } from './item_colours.js';

const kDishColour = '--dish-solid';

function rgb(three, text) {
  return new three.Color(text || '#cccccc');
}

// A cell whose surface is not known shows the dish.
function height_at(dish, index) {
  return Number.isNaN(dish.surface[index]) ? dish.inner[index] : dish.surface[index];
}

function triangles_of(dish) {
  const indices = [];
  for (let row = 0; row + 1 < dish.rows; row += 1) {
    for (let column = 0; column + 1 < dish.columns; column += 1) {
      const near = row * dish.columns + column;
      const far = near + dish.columns;
      const corners = [near, near + 1, far, far + 1];
      const known = corners.filter((corner) => !Number.isNaN(height_at(dish, corner)));
      if (known.length === 4) indices.push(near, near + 1, far, near + 1, far + 1, far);
      // Along edges that run across, half of a cell is known. All triangles face upwards.
      const turns_right = known[1] === far;
      if (known.length === 3) indices.push(...(turns_right ? known.reverse() : known));
    }
  }
  return indices;
}

// x to the right, z up, y away; in millimetres from `centre`.
function positions_of(dish, centre) {
  const positions = new Float32Array(dish.columns * dish.rows * 3);
  for (let index = 0; index < dish.columns * dish.rows; index += 1) {
    const height = height_at(dish, index);
    positions[3 * index] = dish.left + (index % dish.columns) * dish.cell - centre[0];
    positions[3 * index + 1] = dish.near + Math.floor(index / dish.columns) * dish.cell - centre[1];
    positions[3 * index + 2] = Number.isNaN(height) ? 0 : height;
  }
  return positions;
}

// Colours the vertices by their items; `lit(label)`: which stand out, null: all alike.
export function paint_mesh(three, mesh, dish, scan, lit) {
  const style = getComputedStyle(document.documentElement);
  const plate = rgb(three, style.getPropertyValue(kDishColour).trim());
  const palette = new Map([[0, plate]]);
  const colours = mesh.geometry.getAttribute('color');
  dish.labels.forEach((label, index) => {
    if (!palette.has(label)) palette.set(label, rgb(three, colour_of_label(label, scan)));
    const { r, g, b } = palette.get(label);
    const dim = lit !== null && !lit(label) ? 0.45 : 1;
    colours.setXYZ(index, r * dim, g * dim, b * dim);
  });
  colours.needsUpdate = true;
}

export function make_mesh(three, dish, scan, centre) {
  const geometry = new three.BufferGeometry();
  const count = dish.columns * dish.rows;
  geometry.setAttribute('position', new three.BufferAttribute(positions_of(dish, centre), 3));
  geometry.setAttribute('color', new three.BufferAttribute(new Float32Array(count * 3), 3));
  geometry.setIndex(triangles_of(dish));
  geometry.computeVertexNormals();
  // Older libraries have a constant where newer ones have true.
  const vertexColors = three.VertexColors ?? true;
  const material = new three.MeshLambertMaterial({ vertexColors, side: three.DoubleSide });
  const mesh = new three.Mesh(geometry, material);
  paint_mesh(three, mesh, dish, scan, null);
  return mesh;
}
