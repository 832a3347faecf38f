// Builds elements. Data reaches the page only as text nodes and attributes, so that no name of a food can
// become markup.

const kSvg = 'http://www.w3.org/2000/svg';

function fill(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name === 'on') {
      for (const [event, action] of Object.entries(value)) node.addEventListener(event, action);
    } else if (name === 'value') {
      node.value = value;
    } else {
      node.setAttribute(name, value === true ? '' : String(value));
    }
  }
  node.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return node;
}

// element('p', {class: 'note', on: {click: f}}, 'text', other_element, [more])
export function element(tag, attributes = {}, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

export function drawing(tag, attributes = {}, ...children) {
  return fill(document.createElementNS(kSvg, tag), attributes, children);
}

// What the hub or a station wrote: it is English whatever the page's language.
export function hub_text(text, attributes = {}) {
  return element('span', { lang: 'en', ...attributes }, text);
}

let last_id = 0;

// For labels that point to their fields.
export function new_id(prefix) {
  last_id += 1;
  return `${prefix}-${last_id}`;
}
