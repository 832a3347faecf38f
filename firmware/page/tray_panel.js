// The last tray in three drawings, of which one is shown: outlines, heights, 3-D.
import { element } from './elements.js';
import { live } from './live_data.js';
import { item_sentence } from './sentences.js';
import { read_shape } from './tray_shape.js';
import { show_heights } from './tray_heights.js';
import { show_outlines } from './tray_outlines.js';
import { show_space } from './tray_space.js';
import { word, word_of } from './words.js';

const kDrawings = { outlines: show_outlines, heights: show_heights, space: show_space };

// The next tray is shown as the last one was.
let chosen = 'outlines';

function caption_text(scan, selection) {
  const item = scan.items.find((candidate) => candidate.label === selection.label);
  return item ? item_sentence(item) : word('tray.hint');
}

class Panel {
  constructor(shape, scan, selection) {
    this.shape = shape;
    this.scan = scan;
    this.selection = selection;
    this.stage = element('div', { class: 'stage' });
    this.buttons = Object.keys(kDrawings).map((name) => element('button', {
      type: 'button', class: 'choice', value: name, on: { click: () => this.choose(name) },
    }, word_of('drawing', name)));
    const caption = element('p', { class: 'tray-caption', 'data-caption': '' });
    const tell = () => {
      caption.textContent = caption_text(scan, selection);
      caption.classList.toggle('is-hint', selection.label === null);
    };
    selection.addEventListener('change', tell);
    tell();
    const choices = element('div', { class: 'choices', role: 'group', 'aria-label': word('tray.drawings') },
      this.buttons);
    const mesh = element('a', {
      class: 'quiet note', download: '', href: `api/v1/scans/${encodeURIComponent(scan.id)}/mesh`,
    }, word('tray.mesh'));
    this.node = element('div', { class: 'tray-panel' }, choices, this.stage, caption, mesh);
    this.choose(chosen);
  }

  choose(name) {
    chosen = name;
    this.close();
    this.shown = new AbortController();
    this.stage.replaceChildren(kDrawings[name](this.shape, this.scan, this.selection, this.shown.signal));
    for (const button of this.buttons) button.setAttribute('aria-pressed', String(button.value === name));
  }

  close() {
    this.shown?.abort();
  }
}

// Fills `frame` with the tray's drawings. The hub gets a shape shortly after its scan, and forgets it after
// some further ones. Returns what closes the drawings.
export function show_tray(frame, scan, selection) {
  const closing = new AbortController();
  const { signal } = closing;
  if (scan.items.length === 0) return () => {};  // nothing was found that could be drawn
  let panel = null;
  const read = async () => {
    if (panel !== null) return;
    const shape = await read_shape(scan.id).catch(() => null);
    if (signal.aborted || panel !== null) return;
    if (shape === null) {
      frame.replaceChildren(element('p', { class: 'quiet no-shape' }, word('tray.no_shape')));
      return;
    }
    panel = new Panel(shape, scan, selection);
    frame.replaceChildren(panel.node);
  };
  live.addEventListener('open', read, { signal });
  live.addEventListener('shape', (event) => {
    if (JSON.parse(event.detail).id === scan.id) read();
  }, { signal });
  signal.addEventListener('abort', () => panel?.close());
  read();
  return () => closing.abort();
}
