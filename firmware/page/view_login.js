// Asks for a token. It goes to the hub in a request's body, and nowhere else.
import { element, new_id } from './elements.js';
import { error_note } from './error_note.js';
import { log_in } from './session.js';
import { word } from './words.js';

export function show_login(main, on_logged_in) {
  const id = new_id('token');
  const field = element('input', {
    id, type: 'password', required: true, autocomplete: 'current-password', 'aria-describedby': `${id}-hint`,
  });
  const problem = element('div', {});
  const form = element('form', { class: 'card login' },
    element('h1', {}, word('login.title')),
    element('p', { id: `${id}-hint`, class: 'quiet' }, word('login.hint')),
    element('div', { class: 'field' }, element('label', { for: id }, word('login.token')), field),
    element('button', { type: 'submit', class: 'main-button' }, word('login.submit')), problem);
  form.addEventListener('submit', async (event) => {
    event.preventDefault();
    const token = field.value.trim();
    field.value = '';
    try {
      await log_in(token);
      on_logged_in();
    } catch (error) {
      problem.replaceChildren(error_note(error));
      field.focus();
    }
  });
  main.append(form);
  field.focus();
}
