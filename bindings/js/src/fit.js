// Maps from what is known only in part. See icc_fit_create().
import { Handle } from './core.js';
import { withDomains } from './domain.js';
import { exactly, flat, indices, meshOf } from './points.js';

/** The targets of n points or vertices. */
function targetsOf(targets, n, what) {
  const t = flat(targets, 2);
  if (t.length !== 2 * n) throw new TypeError(`${what}: ${n} need targets, but there are ${t.length / 2}`);
  return t;
}

/** Points or a line, as C takes them. */
function ofPoints(kind, points, targets, more = {}) {
  const source = flat(points, 2), n = source.length / 2;
  return { kind, n, source, target: targetsOf(targets, n, kind), ...more };
}

/** Everything that is known, as C takes it. */
function constraintsOf(points, to, { lines = [], vertices, places, sliding, along, tolerance }) {
  const all = [];
  if (points) {
    const loose = typeof tolerance === 'number' ? new Float64Array(flat(points, 2).length / 2).fill(tolerance) : tolerance;
    all.push(ofPoints('points', points, to));
    if (loose) all[0].tolerance = Float64Array.from(exactly(loose, all[0].n, 'tolerance'));
  }
  all.push(...lines.map(([before, after]) => ofPoints('line', before, after)));
  if (vertices) {
    const numbers = indices(vertices);
    all.push({ kind: 'vertices', n: numbers.length, vertices: numbers, target: targetsOf(places, numbers.length, 'vertices') });
  }
  if (sliding) {
    const numbers = indices(sliding), direction = along ? exactly(flat(along, 2), 2 * numbers.length, 'along') : null;
    all.push({ kind: 'sliding', n: numbers.length, vertices: numbers, direction });
  }
  return all;
}

/** The class Fit of an instance. */
export function fitOf(core, Domain, Map) {
  return class Fit extends Handle {
    /** points, to: points and where they go, or null. domain: a Domain or an outline, whose boundary is free where nothing
     *  tells it; null: a box around the points. known: { mesh, lines, vertices, places, sliding, along, tolerance } and
     *  members of icc_fit_options. */
    constructor(points, to = null, domain = null, known = null) {
      super(core, points, () => {
        const { mesh = null, lines, vertices, places, sliding, along, tolerance, ...options } = known ?? {};
        const all = constraintsOf(points, to, { lines, vertices, places, sliding, along, tolerance });
        const own = mesh && meshOf(2, flat(mesh.vertices, 2), indices(mesh.simplices, 3));
        if (options.box) options.box = exactly(flat(options.box, 2), 4, 'box');
        if (options.cellStiffness) exactly(options.cellStiffness, own ? own.nCells : 0, 'cellStiffness');
        return withDomains(Domain, domain ? { domain } : {},
          (d = null) => core.call('icc_fit_create', d, own, all.length, all, options));
      }, 'icc_fit_free');
    }

    /** The members of icc_fit_info. */
    get info() { return core.info('icc_fit_get_info', this); }
    get dim() { return 2; }

    /** The map, which keeps the fit. */
    get map() { return new Map(core.made('icc_fit_map', this), null, null, this); }

    /** The image of each item minus its target, 2 numbers each: points first, then lines, vertices and sliding vertices. */
    residuals() {
      const out = new Float64Array(2 * this.info.nItems);
      core.call('icc_fit_get_residuals', this, out, null);
      return out;
    }

    /** Where the other points alone would take each point, minus its target; NaN where that is not known. */
    leftOut() {
      const out = new Float64Array(2 * this.info.nItems);
      core.call('icc_fit_get_residuals', this, null, out);
      return out;
    }

    /** Makes the fit to targets of all items that have moved, starting from this one. Use it for dragging. */
    move(to) {
      return new Fit(core.made('icc_fit_move', this, targetsOf(to, this.info.nItems, 'items')));
    }
  };
}
