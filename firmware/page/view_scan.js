// One scan with everything that is known of it, and its corrections.
import { element } from './elements.js';
import { error_note } from './error_note.js';
import { get, get_picture } from './hub_api.js';
import { live } from './live_data.js';
import { check_section } from './check_table.js';
import { correction_panel } from './correction_form.js';
import { correction_list } from './correction_list.js';
import { format_number } from './numbers.js';
import { scan_body } from './scan_figures.js';
import { scan_line } from './scan_head.js';
import { Selection } from './selection.js';
import { format_time } from './times.js';
import { show_tray } from './tray_panel.js';
import { word } from './words.js';

// Shown where the owner allows pictures at all; nothing says that one is missing.
async function show_picture(frame, scan, signal) {
  const picture = await get_picture(`scans/${encodeURIComponent(scan.id)}/picture`).catch(() => null);
  if (picture === null || signal.aborted) return;
  const address = URL.createObjectURL(picture);
  signal.addEventListener('abort', () => URL.revokeObjectURL(address));
  frame.append(element('figure', { class: 'picture' },
    element('img', { src: address, alt: word('scan.picture_alt', { scan: scan.id }) }),
    element('figcaption', { class: 'quiet' }, word('scan.picture'))));
}

// Of both pictures; null where neither was measured.
function blur_text(scan) {
  const blurs = Array.isArray(scan.blur_px) ? scan.blur_px : [];
  if (!blurs.some((blur) => typeof blur === 'number')) return null;
  return blurs.map((blur) => (typeof blur === 'number' ? `${format_number(blur, 2)} px` : '–')).join(' · ');
}

function facts(scan) {
  const facts_told = [
    ['scan.taken_at', format_time(scan.taken_at)],
    ['scan.received_at', format_time(scan.received_at)],
    ['scan.station', scan.station],
    ['scan.number', String(scan.number)],
    ['scan.tray_name', scan.tray],
    ['scan.duration', scan.duration_ms && word('number.milliseconds', { count: format_number(scan.duration_ms) })],
    ['scan.blur', blur_text(scan)],
  ];
  const list = facts_told.filter(([, value]) => value).map(([key, value]) =>
    element('div', {}, element('dt', {}, word(key)), element('dd', {}, value)));
  return element('section', { class: 'card', 'aria-labelledby': 'facts-head' },
    element('h2', { id: 'facts-head' }, word('scan.facts')),
    element('dl', { class: 'facts' }, list),
    element('a', { href: `api/v1/scans/${encodeURIComponent(scan.id)}/document`, target: '_blank',
      rel: 'noopener' }, word('scan.document')));
}

class ScanView {
  constructor(main, id, signal) {
    this.main = main;
    this.path = `scans/${encodeURIComponent(id)}`;
    this.id = id;
    this.signal = signal;
    this.body = element('div', { class: 'scan-view' }, element('p', { class: 'quiet' }, word('page.loading')));
    main.append(element('h1', {}, word('scan.title', { scan: id })), this.body);
    signal.addEventListener('abort', () => this.shown?.abort());
    live.addEventListener('correction', (event) => this.note_correction(event.detail), { signal });
    this.read();
  }

  async read() {
    try {
      const [scan, { corrections }] = await Promise.all([get(this.path), get(`${this.path}/corrections`)]);
      if (!this.signal.aborted) this.show(scan, corrections);
    } catch (error) {
      this.body.replaceChildren(error_note(error));
    }
  }

  // Somebody else's correction; ours is read after it was saved.
  note_correction(text) {
    if (JSON.parse(text).id === this.id && !this.is_typing()) this.read();
  }

  // A form that somebody fills in is not taken away.
  is_typing() {
    const form = this.body.querySelector('form');
    return form?.contains(document.activeElement) && document.activeElement.value !== '';
  }

  show(scan, corrections) {
    // One correction is told twice, by the answer and by the event: the second changes nothing, and must not
    // take focus or a filled form away.
    const text = JSON.stringify([scan, corrections]);
    if (text === this.shown_text) return;
    this.shown_text = text;
    this.shown?.abort();
    this.shown = new AbortController();
    const { signal } = this.shown;
    const selection = new Selection();
    const tray = element('div', {});
    const picture = element('div', {});
    const close = show_tray(tray, scan, selection);
    signal.addEventListener('abort', close);
    show_picture(picture, scan, signal);
    const saved = element('div', { role: 'status' });
    const panel = correction_panel(scan, corrections, () => this.note_saved());
    this.body.replaceChildren(
      scan_line(scan),
      element('section', { class: 'card', 'aria-label': word('scan.result') },
        element('h2', { class: 'unseen' }, word('scan.result')),
        scan_body(scan, selection, tray, picture)),
      element('section', { class: 'card', 'aria-labelledby': 'corrections-head' },
        element('h2', { id: 'corrections-head', tabindex: '-1' }, word('correction.title')), saved,
        correction_list(corrections), panel),
      check_section(scan) ?? '',
      facts(scan));
  }

  // The form was made anew: focus goes to the list in which the correction stands now.
  async note_saved() {
    await this.read();
    this.body.querySelector('#corrections-head')?.focus();
    document.getElementById('announcements').textContent = word('correction.saved');
  }
}

export function show_scan(main, { path }, signal) {
  return new ScanView(main, path[0] ?? '', signal);
}
