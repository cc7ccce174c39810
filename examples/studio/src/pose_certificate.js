// The certified map to the outline of a pose, as mode handles shows it, or why there is none.
import { foldedOf } from './mesh.js';

const CROSSING = 'The outline of this pose crosses itself: no one-to-one map has it.';

/** Why a pose has no certified map. */
function reasonOf({ error, outside, targetDefects }) {
  if (targetDefects?.some((d) => d.kind === 'crossing')) return CROSSING;
  return outside === undefined ? `${error.message}.` : `Handle ${outside + 1} lies outside the outline of this pose.`;
}

/** The handles that are not on the outline: a certified map has them where the pose has them. */
export function heldOf({ handles, outline }) {
  const onRing = (p) => outline.some(([x, y]) => x === p[0] && y === p[1]);
  return handles.map((_, h) => h).filter((h) => !onRing(handles[h]));
}

export class PoseCertificate {
  /** What a test looks at: maps that were certified; those that were not, and their triangles that fold. */
  stats = { certified: 0, broken: 0 };
  mesh = null;
  reason = null;

  clear() { this.mesh = this.reason = null; }

  /** What the engine gives: the map of this pose, or an error. */
  take(map) {
    this.clear();
    if (map.error) { this.reason = reasonOf(map); return; }
    this.mesh = { ...map, folded: foldedOf(map.vertices, map.images, map.triangles) };
    ++this.stats[map.certified ? 'certified' : 'broken'];
    this.stats.broken += this.mesh.folded.length / 3;
  }

  /** What stands on the card, and on the badge of the pose: red only where something folds, or was asked for in vain. */
  report({ folded, triangles }) {
    const folds = folded.length / 3, good = this.mesh?.certified, text = `${folds} of ${triangles.length / 3} triangles folded`;
    const state = good ? 'good' : folds > 0 || this.mesh || this.reason ? 'bad' : 'open';
    const title = { good: 'Certified one-to-one', bad: 'Not certified', open: 'Nothing folded' }[state];
    const why = good ? 'The map through the outline of this pose.' : this.reason ?? 'Poses by weights are not certified by themselves.';
    return {
      card: { state, title, lines: [text, why] },
      badge: [state, state === 'open' ? '0 folded' : `${good ? '' : 'not '}certified, ${folds} folded`],
    };
  }
}
