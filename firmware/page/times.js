// Times in the site's time zone: the hub's own times are all UTC.
import { language } from './words.js';

// Where the hub names no zone, the browser's is used.
let site_zone = null;

export function set_site_zone(zone) {
  try {
    new Intl.DateTimeFormat('en', { timeZone: zone });
    site_zone = zone;
  } catch {
    site_zone = null;  // this browser does not know the zone
  }
}

export function time_zone() {
  return site_zone ?? Intl.DateTimeFormat().resolvedOptions().timeZone;
}

export function is_zone_of_site() {
  return site_zone !== null;
}

const kStyles = {
  full: { dateStyle: 'medium', timeStyle: 'medium' },
  short: { dateStyle: 'short', timeStyle: 'short' },
  clock: { timeStyle: 'medium' },
};

// `time`: text of the hub, a Date, or milliseconds.
export function format_time(time, style = 'full') {
  const date = new Date(time);
  if (Number.isNaN(date.getTime())) return String(time);
  return new Intl.DateTimeFormat(language, { ...kStyles[style], timeZone: time_zone() }).format(date);
}

// The clock alone for a time of today, else with its day.
export function format_recent(time) {
  const day = (value) => format_day(new Date(value));
  return format_time(time, day(time) === day(Date.now()) ? 'clock' : 'full');
}

function parts_of(date) {
  const options = {
    timeZone: time_zone(), hourCycle: 'h23', year: 'numeric', month: '2-digit', day: '2-digit',
    hour: '2-digit', minute: '2-digit', second: '2-digit',
  };
  const parts = new Intl.DateTimeFormat('en', options).formatToParts(date);
  return Object.fromEntries(parts.map((part) => [part.type, part.value]));
}

// "2026-11-27", as date fields hold it.
export function format_day(date) {
  const { year, month, day } = parts_of(date);
  return `${year}-${month}-${day}`;
}

// When that day begins in the zone, as UTC text for the API; `days` later where given.
export function start_of_day(day, days = 0) {
  const [year, month, date] = day.split('-').map(Number);
  const wanted = Date.UTC(year, month - 1, date + days);
  let guess = wanted;
  // The second step matters where the clock changes between the guess and the start of the day.
  for (let step = 0; step < 2; step += 1) {
    const seen = parts_of(new Date(guess));
    const shown = Date.UTC(seen.year, seen.month - 1, seen.day, seen.hour, seen.minute, seen.second);
    guess += wanted - shown;
  }
  return new Date(guess).toISOString();
}

// A day that somebody wrote down, such as "2026-01-31": the same in every zone.
export function format_written_day(text) {
  return new Intl.DateTimeFormat(language, { dateStyle: 'medium', timeZone: 'UTC' }).format(new Date(`${text}T00:00Z`));
}
