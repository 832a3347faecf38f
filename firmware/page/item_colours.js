// Each item's colour: by its place in the scan, so that neighbours differ.

// A part that was split off has the place of the item that it came from in drawings, its own in tables.
export function item_number(item, scan) {
  return scan.items.indexOf(item);
}

function root_label(item, scan) {
  let root = item;
  // Parts of parts: each step leads to an earlier item.
  for (let step = 0; step < scan.items.length && root.split_from !== null; step += 1) {
    const parent = scan.items.find((candidate) => candidate.label === root.split_from);
    if (!parent) break;
    root = parent;
  }
  return root.label;
}

// The item of the scan that a label of the measured shape belongs to now; null where there is none.
export function item_of_label(label, scan) {
  return scan.items.find((item) => item.label === label)
    ?? scan.items.find((item) => item.merged.includes(label)) ?? null;
}

// Whether that label of the shape lights up when the item `chosen` is pointed at.
export function is_lit(label, chosen, scan) {
  if (chosen === null) return false;
  const item = item_of_label(label, scan);
  if (item === null) return false;
  if (item.label === chosen) return true;
  const pointed = scan.items.find((candidate) => candidate.label === chosen);
  return pointed !== undefined && root_label(pointed, scan) === item.label;
}

// As the style sheets define it, for drawings that are made of pixels.
export function colour_of_label(label, scan) {
  const item = item_of_label(label, scan);
  const name = item === null ? '--item-none' : `--item-${item_number(item, scan) % 8}`;
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}
