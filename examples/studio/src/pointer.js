// The place under the pointer, and the one that belongs to it in the other picture.
import { ask } from './ask.js';
import { draw } from './dom.js';

const textOf = (point) => `${point[0].toFixed(1)}, ${point[1].toFixed(1)}`;
const spot = (panel, at) => draw('circle', { class: 'spot', cx: at[0], cy: at[1], r: 5 * panel.unit });

/** Marks them in the panels `before` and `after` of a mode, while nothing is drawn or dragged there. `operation` maps points.
 *  Returns what clears the marks. */
export function watchPointer(mode, drawings, remote, operation = 'cage.points') {
  const { before, after, overlays } = mode, drawing = () => drawings.some((d) => d.active);
  const clear = () => {
    for (const side of ['before', 'after']) {
      overlays[side].mark();
      mode[side].note.textContent = '';
    }
  };
  for (const [here, there, forth] of [[before, after, true], [after, before, false]]) {
    const [ours, theirs] = forth ? [overlays.before, overlays.after] : [overlays.after, overlays.before];
    here.svg.addEventListener('pointerleave', clear);
    here.svg.addEventListener('pointermove', (event) => {
      if (drawing() || Object.values(overlays).some((o) => o.busy)) return;
      const at = here.at(event);
      ask(remote, 'spot', operation, { points: Float64Array.from(at), forth }, ({ points }) => {
        if (drawing()) return;
        if (!points?.length || Number.isNaN(points[0])) {
          clear();
          return;
        }
        ours.mark(spot(here, at));
        theirs.mark(spot(there, points));
        here.note.textContent = textOf(at);
        there.note.textContent = `${forth ? 'goes to' : 'comes from'} ${textOf(points)}`;
      });
    });
  }
  return clear;
}
