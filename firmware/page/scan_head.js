// What has to be said about a scan before its figures: when, where, and everything that makes it doubtful.
import { element, hub_text } from './elements.js';
import { live } from './live_data.js';
import { mark } from './marks.js';
import { is_refused, sentence_with_scan, status_text } from './sentences.js';
import { format_recent } from './times.js';
import { word } from './words.js';

function notice(kind, ...content) {
  return element('div', { class: `notice notice-${kind}` }, mark(kind), element('p', {}, content));
}

function refusal(scan) {
  const is_known_to_page = status_text(scan).lang !== 'en';
  // A device's failure has details that no word of ours can hold.
  const details = is_known_to_page && scan.message?.includes(': ') ? [' ', hub_text(`(${scan.message})`)] : [];
  return notice('fault', element('strong', {}, word('scan.refused')), ' ', status_text(scan), details);
}

// What concerns the tray; whoever eats from it cannot set a clock.
export function tray_notices(scan) {
  const notices = [];
  if (is_refused(scan)) notices.push(refusal(scan));
  if (scan.status === 'partial') notices.push(notice('warning', word('scan.partial')));
  if (scan.is_wrong) notices.push(notice('warning', word('scan.marked_wrong')));
  if (scan.superseded_by) {
    notices.push(notice('warning', sentence_with_scan('scan.superseded_by', scan.superseded_by)));
  }
  if (scan.supersedes) notices.push(notice('busy', sentence_with_scan('scan.supersedes', scan.supersedes)));
  return notices;
}

export function scan_notices(scan) {
  const notices = tray_notices(scan);
  if (scan.clock_synchronised === false) notices.push(notice('warning', word('scan.clock')));
  if (scan.board?.under_voltage === true) notices.push(notice('warning', word('scan.under_voltage')));
  return notices;
}

// In place of the last tray, where none can be shown.
export function no_scan_text() {
  if (live.store_problem !== null) return word('error.store');
  return word(live.is_latest_known ? 'live.no_scan' : 'page.loading');
}

export function scan_line(scan) {
  const parts = [format_recent(scan.taken_at), word('scan.at_station', { station: scan.station })];
  if (scan.tray) parts.push(word('scan.tray', { tray: scan.tray }));
  return element('p', { class: 'quiet scan-line' }, parts.join(' · '));
}
