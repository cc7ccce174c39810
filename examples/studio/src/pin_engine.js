// Figures that follow pins: fits with a free outline, moved and kept for undo.
import { Kept } from './kept.js';
import { domainArguments, flatOf } from './shape.js';

const REACHED = 1e-6;          // pixels: rounding moves a pin that is reached by less

const keyOf = ({ figure, pins, reach }) => JSON.stringify([figure, pins, reach]);

/** A fit, and what it is of: only targets may differ in a fit that it moves to. */
class Pinned {
  constructor(fit, state) { [this.fit, this.map, this.key] = [fit, fit.map, keyOf(state)]; }

  free() { this.fit.free(); }
}

export function pinOperations(icc) {
  const fits = new Kept();

  /** Without a pin, the first corner stays, and so does everything. */
  function create({ figure, pins, targets, reach }) {
    const domain = icc.Domain.polygon(...domainArguments(figure));
    try {
      return pins.length > 0 ? new icc.Fit(flatOf(pins), flatOf(targets), domain, { reach })
        : new icc.Fit(null, null, domain, { vertices: [0], places: figure[0].points.slice(0, 1) });
    } finally {
      domain.free();
    }
  }

  /** The fit as the page draws it, and how far each pin is from its place. */
  function picture({ pins }) {
    const { fit, map } = fits.now, { vertices, images, simplices } = map.mesh();
    const { certified, energy } = map.info, off = fit.residuals();
    const distances = Float64Array.from(pins, (_, i) => {
      const d = Math.hypot(off[2 * i], off[2 * i + 1]);
      return d > REACHED ? d : 0;
    });
    return { vertices, images, triangles: simplices, certified: certified === 1, energy, off, distances };
  }

  return {
    /** A fit anew. */
    'pins.make'(state) {
      fits.become(new Pinned(create(state), state), state.number);
      return picture(state);
    },

    /** The fit to targets that have moved. It stays as it was when there is none. */
    'pins.move'(state) {
      if (fits.now?.key !== keyOf(state)) return this['pins.make'](state);
      fits.become(new Pinned(fits.now.fit.move(flatOf(state.targets)), state), state.number);
      return picture(state);
    },

    /** The fit of a state that was kept, or a new one. */
    'pins.recall'(state) {
      if (!fits.get(state.number)) return this['pins.make'](state);
      fits.become(fits.get(state.number));
      return picture(state);
    },

    /** Where points come from, or go to. */
    'pins.points'({ points, forth }) {
      if (fits.now === null) return { points: [] };
      const { map } = fits.now;
      return { points: forth ? map.apply(points) : map.inverse(points) };
    },

    'pins.warp'({ picture: from, width, height }) {
      const to = { width, height, data: new Uint8ClampedArray(4 * width * height) };
      fits.now.map.warp(from, to);
      return { pixels: to.data };
    },
  };
}
