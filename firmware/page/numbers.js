// Numbers as people of the page's language write them.
import { language, word, word_count } from './words.js';

export function format_number(value, digits = 0) {
  const options = { minimumFractionDigits: digits, maximumFractionDigits: digits };
  const rounded = Number(value.toFixed(digits)) + 0; // -0.00 is 0.00
  return new Intl.NumberFormat(language, options).format(rounded);
}

// One digit after the point only where the volume is known that well.
function digits_of(volume_ml, sigma_ml) {
  return (sigma_ml ?? volume_ml / 20) < 1 ? 1 : 0;
}

export function format_volume(volume_ml, sigma_ml = null) {
  return word('number.volume', { volume: format_number(volume_ml, digits_of(volume_ml, sigma_ml)) });
}

// "142 ml ± 5 ml"
export function format_measured(volume_ml, sigma_ml) {
  if (volume_ml === null) return word('item.no_volume');
  if (sigma_ml === null || sigma_ml === undefined) return format_volume(volume_ml);
  const digits = digits_of(volume_ml, sigma_ml);
  return word('number.measured', {
    volume: format_number(volume_ml, digits),
    sigma: format_number(sigma_ml, digits),
  });
}

// "12 s", "3 minutes", "5 hours", "2 days"
export function format_age(seconds) {
  const whole = Math.max(0, Math.floor(seconds));
  if (whole < 60) return word('number.seconds', { count: whole });
  if (whole < 3600) return word_count('number.minutes', Math.floor(whole / 60));
  if (whole < 172800) return word_count('number.hours', Math.floor(whole / 3600));
  return word_count('number.days', Math.floor(whole / 86400));
}

export function format_bytes(bytes) {
  const units = ['B', 'kB', 'MB', 'GB'];
  let value = bytes;
  let unit = 0;
  while (value >= 1000 && unit < units.length - 1) {
    value /= 1000;
    unit += 1;
  }
  return `${format_number(value, unit > 0 && value < 10 ? 1 : 0)} ${units[unit]}`;
}
