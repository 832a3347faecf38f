// Who looks at the page, and what they may do.
import { get, log_in as ask_login, log_out as ask_logout } from './hub_api.js';

// `role`: none, view, kiosk or manage; `name` is that of the token, empty where it has none.
export const session = { role: 'none', name: '' };

export async function read_session() {
  Object.assign(session, await get('session'));
}

let leaving = Promise.resolve();

export async function log_in(token) {
  // The answer to a logout takes the cookie away, whenever it comes.
  await leaving;
  Object.assign(session, await ask_login(token));
}

// The cookie is the hub's: this page never holds the token after it was sent.
export function log_out() {
  Object.assign(session, { role: 'none', name: '' });
  leaving = ask_logout().catch(() => {});
}
