// Run inside of the page by page_case.py: returns what hinders people, a sentence each, and the lowest contrast.
const problems = [];
const name_of = (node) => `<${node.tagName.toLowerCase()} class="${node.getAttribute('class') ?? ''}">`;
const is_shown = (node) => node.getClientRects().length > 0 && getComputedStyle(node).visibility !== 'hidden';

// Colours as [red, green, blue, alpha], 0 to 1.
function rgba(text) {
  const numbers = (text.match(/[\d.]+/g) ?? []).map(Number);
  const [red, green, blue, alpha = 1] = numbers;
  return numbers.length < 3 ? [0, 0, 0, 0] : [red / 255, green / 255, blue / 255, alpha];
}

function over(front, back) {
  const mixed = [0, 1, 2].map((i) => front[i] * front[3] + back[i] * (1 - front[3]));
  return [...mixed, 1];
}

function background_of(node) {
  const layers = [];
  for (let at = node; at !== null; at = at.parentElement) layers.push(rgba(getComputedStyle(at).backgroundColor));
  const dark = matchMedia('(prefers-color-scheme: dark)').matches;
  return layers.reverse().reduce((back, front) => over(front, back), dark ? [0, 0, 0, 1] : [1, 1, 1, 1]);
}

function luminance(colour) {
  const [red, green, blue] = colour.map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4));
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

function contrast(one, other) {
  const [dark, light] = [luminance(one), luminance(other)].sort((a, b) => a - b);
  return (light + 0.05) / (dark + 0.05);
}

// Text of a drawing stands on the circle before it.
function colours_of(node) {
  const style = getComputedStyle(node);
  if (!(node instanceof SVGElement)) return [rgba(style.color), background_of(node)];
  const circle = node.parentElement.querySelector('circle');
  return [rgba(style.fill), rgba(getComputedStyle(circle).fill)];
}

function check_contrast() {
  let lowest = 99;
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const node = walker.currentNode.parentElement;
    if (!walker.currentNode.data.trim() || !is_shown(node) || node.closest('noscript, option, .unseen')) continue;
    const [text, back] = colours_of(node);
    const found = contrast(over(text, back), back);
    lowest = Math.min(lowest, found);
    const what = `"${walker.currentNode.data.slice(0, 40)}" in ${name_of(node)}`;
    if (found < 4.5) problems.push(`contrast ${found.toFixed(2)}: ${what}`);
  }
  return lowest;
}

function accessible_name(node) {
  const labels = [...(node.labels ?? [])].map((label) => label.textContent).join(' ');
  const text_of = (id) => document.getElementById(id)?.textContent ?? '';
  const by = (node.getAttribute('aria-labelledby') ?? '').split(' ').map(text_of);
  const own = node.matches('button, a') ? node.textContent : '';
  return [node.getAttribute('aria-label') ?? '', ...by, labels, own].join('').trim();
}

function check_names() {
  const roles = ['group', 'application', 'img', 'search'].map((role) => `:not(img)[role=${role}]`);
  for (const node of document.querySelectorAll(['a, button, input, select, nav, section', ...roles].join())) {
    if (is_shown(node) && accessible_name(node) === '') problems.push(`no name: ${name_of(node)}`);
  }
  for (const image of document.querySelectorAll('img')) {
    if (!image.hasAttribute('alt')) problems.push(`no alt: ${name_of(image)}`);
  }
  for (const canvas of document.querySelectorAll('canvas')) {
    const is_told = canvas.hasAttribute('role') || canvas.closest('[aria-hidden=true]');
    if (!is_told) problems.push(`no role: ${name_of(canvas)}`);
  }
}

function check_structure() {
  const count = (selector) => document.querySelectorAll(selector).length;
  if (count('h1') !== 1) problems.push(`${count('h1')} h1`);
  if (count('main') !== 1) problems.push(`${count('main')} main`);
  if (count('[aria-live=polite]') < 1) problems.push('no live region');
  const chosen = document.querySelector('#languages [aria-pressed=true]').value;
  if (document.documentElement.lang !== chosen) problems.push('lang');
  const levels = [...document.querySelectorAll('h1, h2, h3, h4')].map((head) => Number(head.tagName[1]));
  levels.forEach((level, i) => {
    if (i > 0 && level > levels[i - 1] + 1) problems.push(`h${level} after h${levels[i - 1]}`);
  });
  for (const table of document.querySelectorAll('table')) {
    if (!table.caption) problems.push('a table without a caption');
    for (const head of table.querySelectorAll('th')) if (!head.scope) problems.push('a th without scope');
  }
}

function check_references() {
  const ids = [...document.querySelectorAll('[id]')].map((node) => node.id);
  ids.filter((id, i) => ids.indexOf(id) !== i).forEach((id) => problems.push(`twice: #${id}`));
  for (const name of ['for', 'aria-labelledby', 'aria-describedby', 'list']) {
    for (const node of document.querySelectorAll(`[${name}]`)) {
      for (const id of node.getAttribute(name).split(' ')) {
        if (!ids.includes(id)) problems.push(`${name} names no element: ${id}`);
      }
    }
  }
  for (const node of document.querySelectorAll('[tabindex]')) if (node.tabIndex > 0) problems.push('a tabindex above 0');
  for (const node of document.querySelectorAll('[aria-hidden=true] :is(a, button, input)')) {
    problems.push(`hidden but focused: ${name_of(node)}`);
  }
  for (const node of document.querySelectorAll('[style]')) {
    if (!node.matches('canvas')) problems.push(`a style in line: ${name_of(node)}`);
  }
}

const lowest = check_contrast();
check_names();
check_structure();
check_references();
return { problems, lowest };
