// How somebody who manages says what is wrong with a scan.
import { element, new_id } from './elements.js';
import { error_note } from './error_note.js';
import { post } from './hub_api.js';
import { correction_text, last_holding } from './correction_list.js';
import { item_sentence } from './sentences.js';
import { session } from './session.js';
import { word, word_of } from './words.js';

const kActions = ['rename', 'merge', 'split', 'item_wrong', 'scan_wrong'];
// Which fields an action needs.
const kFields = {
  rename: ['item', 'food'], merge: ['item', 'others'], split: ['item', 'volume_ml', 'food'],
  item_wrong: ['item'], scan_wrong: [],
};

// Whoever corrects one scan after the other types the name once; it is gone when the page is closed.
let author = '';

function labelled(name, key, field) {
  field.id = new_id('field');
  return element('div', { class: 'field', 'data-field': name },
    element('label', { for: field.id }, word(key)), field);
}

function item_line(item) {
  return item.food ? `${item.label}: ${item_sentence(item)}` : item_sentence(item);
}

function item_field(scan) {
  const options = scan.items.map((item) => element('option', { value: item.label }, item_line(item)));
  return labelled('item', 'correction.item', element('select', { name: 'item' }, options));
}

function others_field(scan) {
  const boxes = scan.items.map((item) => element('label', { class: 'box', 'data-box': item.label },
    element('input', { type: 'checkbox', name: 'others', value: item.label }), item_line(item)));
  return element('fieldset', { class: 'field boxes', 'data-field': 'others' },
    element('legend', {}, word('correction.others')), boxes);
}

function action_field(scan) {
  const possible = kActions.filter((action) => scan.items.length > 0 || kFields[action].length === 0);
  const options = possible.map((action) => element('option', { value: action }, word_of('action', action)));
  return labelled('action', 'correction.action', element('select', { name: 'action' }, options));
}

function make_form(scan) {
  const needs_author = session.name === '';
  return element('form', { class: 'correction-form' },
    action_field(scan), item_field(scan), others_field(scan),
    labelled('volume_ml', 'correction.volume', element('input', {
      name: 'volume_ml', type: 'number', min: '0.1', step: '0.1', inputmode: 'decimal',
    })),
    labelled('food', 'correction.food', element('input', { name: 'food', maxlength: 100, autocomplete: 'off' })),
    needs_author ? labelled('author', 'correction.author', element('input', {
      name: 'author', maxlength: 100, required: true, value: author, autocomplete: 'name',
    })) : null,
    labelled('reason', 'correction.reason', element('input', { name: 'reason', maxlength: 400, autocomplete: 'off' })),
    element('div', { class: 'field actions' },
      element('button', { type: 'submit', class: 'main-button' }, word('correction.save'))));
}

// Shows the fields of the chosen action alone.
function arrange(form) {
  const fields = kFields[form.elements.action.value];
  for (const name of ['item', 'others', 'volume_ml', 'food']) {
    form.querySelector(`[data-field="${name}"]`).hidden = !fields.includes(name);
  }
  form.elements.food.required = form.elements.action.value === 'rename';
  form.elements.volume_ml.required = fields.includes('volume_ml');
  for (const box of form.querySelectorAll('[data-box]')) box.hidden = box.dataset.box === form.elements.item.value;
}

function body_of(form) {
  const data = new FormData(form);
  const action = data.get('action');
  const item = Number(data.get('item'));
  const parts = {
    item, food: data.get('food').trim(), volume_ml: Number(data.get('volume_ml')),
    others: data.getAll('others').map(Number).filter((label) => label !== item),
  };
  const body = { action, reason: data.get('reason').trim() };
  for (const name of kFields[action]) body[name] = parts[name];
  return { ...body, author: author_of(form) };
}

// The hub takes the name from a token that has one, else from the form.
function author_of(form) {
  const field = form.elements.author;
  if (!field) return undefined;
  author = field.value.trim();
  return author;
}

function undo_button(last, form, send) {
  if (last === null) return null;
  const undo = () => {
    const name = author_of(form);
    send({ action: 'undo', number: last.correction, author: name === '' ? word('correction.unnamed') : name });
  };
  return element('button', { type: 'button', class: 'undo', on: { click: undo } },
    word('correction.undo', { what: correction_text(last) }));
}

// `on_saved(scan)` gets the scan as it is after the correction.
export function correction_panel(scan, corrections, on_saved) {
  if (session.role !== 'manage') return element('p', { class: 'quiet' }, word('correction.only_manage'));
  const problem = element('div', {});
  const form = make_form(scan);
  const send = async (body) => {
    try {
      on_saved(await post(`scans/${encodeURIComponent(scan.id)}/corrections`, body));
    } catch (error) {
      problem.replaceChildren(error_note(error));
    }
  };
  form.addEventListener('change', () => arrange(form));
  form.addEventListener('submit', (event) => {
    event.preventDefault();
    send(body_of(form));
  });
  arrange(form);
  return element('div', {}, undo_button(last_holding(corrections), form, send), form, problem);
}
