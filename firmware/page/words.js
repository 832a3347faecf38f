// The page's words in the chosen language, from words_en.json or words_de.json.

export const kLanguages = ['en', 'de'];
const kStored = 'traygauge.language';

let words = {};
let plural = new Intl.PluralRules('en');
export let language = 'en';

// A browser may forbid storage; then the choice lasts until the page is closed.
function stored_language() {
  try {
    return localStorage.getItem(kStored);
  } catch {
    return null;
  }
}

export function choose_language(demanded) {
  const wishes = [demanded, stored_language(), ...(navigator.languages ?? [])];
  const known = wishes.map((wish) => String(wish ?? '').slice(0, 2)).find((wish) => kLanguages.includes(wish));
  return known ?? 'en';
}

export async function load_words(chosen) {
  const answer = await fetch(`words_${chosen}.json`);
  if (!answer.ok) throw new Error(`words_${chosen}.json: ${answer.status}`);
  words = await answer.json();
  language = chosen;
  plural = new Intl.PluralRules(chosen);
  document.documentElement.lang = chosen;
}

export function remember_language(chosen) {
  try {
    localStorage.setItem(kStored, chosen);
  } catch {
    // See stored_language().
  }
}

function filled(text, values) {
  return text.replace(/\{(\w+)\}/g, (whole, name) => (name in values ? String(values[name]) : whole));
}

export function word(key, values = {}) {
  return filled(words[key] ?? key, values);
}

// word_of('status', 'ok') is the word "status.ok"; null where there is none.
export function word_of(family, name, values = {}) {
  const text = words[`${family}.${name}`];
  return text === undefined ? null : filled(text, values);
}

// The key ends in ".one" or ".other", as the language's plural demands.
export function word_count(key, count, values = {}) {
  return word(`${key}.${plural.select(count)}`, { count, ...values });
}

// Fills what index.html marks with data-word (text) and data-word-label (aria-label).
export function fill_words(root) {
  for (const node of root.querySelectorAll('[data-word]')) node.textContent = word(node.dataset.word);
  for (const node of root.querySelectorAll('[data-word-label]')) {
    node.setAttribute('aria-label', word(node.dataset.wordLabel));
  }
}
