// Maps from control points, and the thin plate through the same points.
import { blend, thinPlate } from './baseline.js';
import { flatOf } from './shape.js';

const MOST_COMPARED = 300;     // points: a thin-plate spline takes their cube
const LEAST_COMPARED = 3;      // points that tell an affine map

export function pairOperations(icc) {
  let fit = null, plate = null;

  function become(next) {
    fit?.free();
    fit = next;
  }

  /** Triangles that meet the box of the picture: the map covers more. */
  function inBox(vertices, simplices, [w, h]) {
    const out = [];
    for (let t = 0; t < simplices.length; t += 3) {
      const three = [simplices[t], simplices[t + 1], simplices[t + 2]], xs = three.map((i) => vertices[2 * i]), ys = three.map((i) => vertices[2 * i + 1]);
      if (Math.max(...xs) > 0 && Math.min(...xs) < w && Math.max(...ys) > 0 && Math.min(...ys) < h) out.push(...three);
    }
    return Uint32Array.from(out);
  }

  /** The thin plate at the vertices. Its matrix is kept while only targets move. */
  function compared(points, targets, vertices, compare) {
    if (!compare) return {};
    const n = points.length;
    if (n < LEAST_COMPARED || n > MOST_COMPARED) return { refused: `takes ${LEAST_COMPARED} to ${MOST_COMPARED} points` };
    const from = flatOf(points), key = `${vertices.length} ${vertices[0]} ${vertices.at(-1)} ${from.join()}`;
    if (plate?.key !== key) plate = { key, weights: thinPlate(from, vertices) };
    const other = blend(plate.weights, flatOf(targets));
    return other.every(Number.isFinite) ? { other } : { refused: 'the points lie on a line' };
  }

  const lengths = (list) => Float64Array.from({ length: list.length / 2 }, (_, i) => Math.hypot(list[2 * i], list[2 * i + 1]));

  function picture({ points, targets, size, compare }) {
    const { map } = fit, { vertices, images, simplices } = map.mesh(), { residual, leftOut, affineResidual, nFolded, changed } = fit.info;
    const apart = fit.leftOut();
    return {
      vertices, images, triangles: inBox(vertices, simplices, size), certified: map.certified, nTriangles: simplices.length / 3,
      residuals: lengths(fit.residuals()), apart, leftOuts: lengths(apart), residual, leftOut, affineResidual, nFolded, changed,
      ...compared(points, targets, vertices, compare),
    };
  }

  return {
    /** A fit anew. */
    'points.make'(state) {
      const { points, targets, size: [w, h], tolerance } = state;
      become(new icc.Fit(flatOf(points), flatOf(targets), null, { box: [0, 0, w, h], ...(tolerance > 0 ? { tolerance } : {}) }));
      return picture(state);
    },

    /** The fit to targets that have moved: the mesh stays, and so do margin and smoothing. */
    'points.move'(state) {
      if (fit?.info.nItems !== state.points.length) return this['points.make'](state);
      become(fit.move(flatOf(state.targets)));
      return picture(state);
    },

    /** Where points come from, or go to. */
    'points.points'({ points, forth }) {
      if (fit === null) return { points: [] };
      return { points: forth ? fit.map.apply(points) : fit.map.inverse(points) };
    },

    'points.warp'({ picture: from, width, height }) {
      const to = { width, height, data: new Uint8ClampedArray(4 * width * height) };
      fit.map.warp(from, to);
      return { pixels: to.data };
    },
  };
}
