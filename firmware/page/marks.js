// A shape for each state, so that nobody needs to tell colours apart.
import { drawing } from './elements.js';

const kShapes = {
  good: () => [drawing('circle', { cx: 12, cy: 12, r: 10 }),
    drawing('path', { d: 'M7 12.5l3.5 3.5L17 9', class: 'mark-line' })],
  busy: () => [drawing('circle', { cx: 12, cy: 12, r: 9, class: 'mark-ring' }),
    drawing('circle', { cx: 7.5, cy: 12, r: 1.6 }), drawing('circle', { cx: 12, cy: 12, r: 1.6 }),
    drawing('circle', { cx: 16.5, cy: 12, r: 1.6 })],
  hold: () => [drawing('rect', { x: 2, y: 2, width: 20, height: 20, rx: 4 }),
    drawing('path', { d: 'M9 7.5v9M15 7.5v9', class: 'mark-line' })],
  warning: () => [drawing('path', { d: 'M12 2l11 20H1z' }),
    drawing('path', { d: 'M12 9v6M12 18v.6', class: 'mark-line' })],
  fault: () => [drawing('path', { d: 'M7 1h10l6 6v10l-6 6H7l-6-6V7z' }),
    drawing('path', { d: 'M8 8l8 8M16 8l-8 8', class: 'mark-line' })],
  away: () => [drawing('circle', { cx: 12, cy: 12, r: 9, class: 'mark-ring' }),
    drawing('path', { d: 'M6 18L18 6', class: 'mark-stroke' })],
};

export function mark(kind) {
  return drawing('svg', { class: `mark mark-${kind}`, viewBox: '0 0 24 24', 'aria-hidden': 'true' },
    kShapes[kind]());
}
