// The start of the page: words, session, site; then the view that the address names.
import { announce_connection, show_connection } from './connection_band.js';
import { element } from './elements.js';
import { item_sentence, is_refused } from './sentences.js';
import { live } from './live_data.js';
import { read_address } from './router.js';
import { log_out, read_session, session } from './session.js';
import { read_site, site } from './site.js';
import { format_volume } from './numbers.js';
import { choose_language, fill_words, language, load_words, remember_language, word, word_of } from './words.js';
import { show_about } from './view_about.js';
import { show_devices } from './view_devices.js';
import { show_history } from './view_history.js';
import { show_kiosk } from './view_kiosk.js';
import { show_live } from './view_live.js';
import { show_login } from './view_login.js';
import { show_scan } from './view_scan.js';

const kViews = {
  live: show_live, history: show_history, scan: show_scan, devices: show_devices, about: show_about,
  kiosk: show_kiosk,
};
const kTitles = {
  live: 'live.title', history: 'history.title', scan: 'scan.short_title', devices: 'devices.title',
  about: 'about.title', kiosk: 'kiosk.title',
};

const by_id = (id) => document.getElementById(id);
let shown = new AbortController();

function announce(text) {
  by_id('announcements').textContent = text;
}

function show_frame(view) {
  const is_kiosk = view === 'kiosk';
  document.body.classList.toggle('is-kiosk', is_kiosk);
  by_id('head').hidden = is_kiosk;
  by_id('skip').hidden = is_kiosk;
  for (const link of by_id('views').querySelectorAll('a')) {
    const is_here = link.hash === `#${view}`;
    if (is_here) link.setAttribute('aria-current', 'page');
    else link.removeAttribute('aria-current');
  }
  document.title = [word(kTitles[view]), site.name ?? 'Traygauge'].join(' – ');
  by_id('site-name').textContent = site.name ?? 'Traygauge';
}

function show_session() {
  const role = word_of('role', session.role);
  const who = session.name ? `${session.name} (${role})` : role;
  // On the hub's own machine nobody is logged in, and there is nothing to leave.
  const out = session.name === '' && session.role === 'manage' ? null
    : element('button', { type: 'button', class: 'link', on: { click: () => live.note_login() } }, word('login.leave'));
  const is_anybody = session.role !== 'none' && !live.needs_login;
  by_id('session').replaceChildren(...(is_anybody ? [element('span', { class: 'quiet' }, who), out ?? ''] : []));
}

// Also where the hub no longer knows the token: a cookie that stays would count as a wrong token each time.
function leave() {
  log_out();
  show_view();
}

function show_view() {
  shown.abort();
  shown = new AbortController();
  const address = read_address();
  const view = address.view in kViews ? address.view : 'live';
  const main = by_id('main');
  main.replaceChildren();
  main.className = `view-${view}`;
  show_frame(view);
  show_session();
  if (live.needs_login) show_login(main, begin_session);
  else kViews[view](main, address, shown.signal);
}

async function begin_session() {
  live.begin_session();
  await start_session();
}

// Asks until the hub says who is here: a page that starts while the hub is away must not stay empty.
async function start_session() {
  const kRetryMs = 2000;
  try {
    await read_session();
    await read_site();
    show_view();
  } catch (error) {
    if (error.status === 401) return;  // the login is shown already, and somebody may be typing
    if (by_id('main').childElementCount === 0) show_view();
    setTimeout(start_session, kRetryMs);
  }
}

async function use_language(chosen) {
  await load_words(chosen);
  fill_words(document);
  for (const button of by_id('languages').querySelectorAll('button')) {
    button.setAttribute('aria-pressed', String(button.value === language));
  }
}

function result_sentence(scan) {
  const result = is_refused(scan) ? word('scan.refused')
    : `${format_volume(scan.volume_ml)}: ${scan.items.map(item_sentence).join(', ')}`;
  return `${word('live.new_scan')} ${result}`;
}

function announce_results() {
  let last = null;
  live.addEventListener('latest', () => {
    const scan = live.latest;
    if (last !== null && scan !== null && scan.id !== last) announce(result_sentence(scan));
    last = scan?.id ?? '';
  });
}

function listen() {
  window.addEventListener('hashchange', () => {
    show_view();
    by_id('main').focus();
  });
  live.addEventListener('login', leave);
  by_id('skip').addEventListener('click', () => by_id('main').focus());
  for (const button of by_id('languages').querySelectorAll('button')) {
    button.addEventListener('click', async () => {
      remember_language(button.value);
      await use_language(button.value);
      show_view();
    });
  }
}

await use_language(choose_language(read_address().query.get('lang')));
listen();
show_connection(by_id('connection'));
announce_connection(announce);
announce_results();
live.start();
await start_session();
