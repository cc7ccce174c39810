// Maps of cages: made, followed, kept for undo, compared.
import { blend, meanValue, thinPlate } from './baseline.js';
import { Kept } from './kept.js';
import { domainArguments, flatOf, verticesOf } from './shape.js';

const MOST_COMPARED = 600;     // vertices of a cage: a thin-plate spline takes their cube
const FRAME_STEPS = 2;         // of improvement, in a frame of dragging

export function cageOperations(icc) {
  const maps = new Kept();
  let compared = null;

  const domainOf = (shape) => icc.Domain.polygon(...domainArguments(shape));

  /** The domain of a shape; its errors say whose it is. */
  function sideOf(shape, side) {
    try { return domainOf(shape); } catch (error) {
      if (error instanceof icc.IccError) error.side ??= side;
      throw error;
    }
  }

  /** Runs `work` with the domains of both shapes. */
  function withDomains(source, target, work) {
    const from = sideOf(source, 'source');
    try {
      const to = sideOf(target, 'target');
      try { return work(from, to); } finally { to.free(); }
    } finally {
      from.free();
    }
  }

  const create = (source, target) => withDomains(source, target, (a, b) => new icc.Map(a, b));

  function follow(target) {
    const to = sideOf(target, 'target');
    try { return maps.now.retarget(to, FRAME_STEPS); } finally { to.free(); }
  }

  /** The map as the page draws it. */
  function picture({ source, target, compare }) {
    const { vertices, images, simplices } = maps.now.mesh();
    const { certified, energy, nSimplices, kind, classKept, detour } = maps.now.info;
    return {
      vertices, images, simplices, certified: certified === 1 && kind === 'mesh', energy, nSimplices,
      classKept, detour, ...comparison(source, target, compare, vertices),
    };
  }

  function comparison(source, target, kind, vertices) {
    if (!kind || kind === 'none') return {};
    if (kind === 'gradient') return { other: gradient(source, target, vertices) };
    const features = kind === 'thin-plate';
    const from = features ? verticesOf(source) : flatOf(source[0].points);
    if (from.length / 2 > MOST_COMPARED) return { refused: `more than ${MOST_COMPARED} corners` };
    const key = `${kind} ${vertices.length} ${vertices[0]} ${vertices.at(-1)} ${from.join()}`;
    if (compared?.key !== key) compared = { key, weights: (features ? thinPlate : meanValue)(from, vertices) };
    return { other: blend(compared.weights, features ? verticesOf(target) : flatOf(target[0].points)) };
  }

  /** The papers' own map: NaN where a point has no image. */
  function gradient(source, target, vertices) {
    const other = new icc.Map(flatOf(source[0].points), flatOf(target[0].points),
      { kind: 'curves', chart: { method: 'gradient' } });
    try { return other.apply(vertices); } finally { other.free(); }
  }

  /** Why there is no map, with the pairs of edges of the outline that are in each other's way. */
  function trouble(error, source, target) {
    if (!(error instanceof icc.IccError)) throw error;
    const list = (shape) => icc.boundaryDefects(flatOf(shape[0].points)).slice(0, 32);
    return { error: error.plain, sourceDefects: list(source), targetDefects: list(target) };
  }

  return {
    /** A map anew. */
    'cage.create'({ source, target, number, compare }) {
      try { maps.become(create(source, target), number); } catch (error) { return trouble(error, source, target); }
      return picture({ source, target, compare });
    },

    /** The map to a target that has moved; the old one stays when there is none. */
    'cage.follow'({ source, target, number, compare }) {
      try { maps.become(follow(target), number); } catch (error) { return trouble(error, source, target); }
      return picture({ source, target, compare });
    },

    /** The map of a state that was kept, or a new one. */
    'cage.recall'({ source, target, number, compare }) {
      if (!maps.get(number)) return this['cage.create']({ source, target, number, compare });
      maps.become(maps.get(number));
      return picture({ source, target, compare });
    },

    /** A fairer one. */
    'cage.improve'({ source, target, number, compare }) {
      if (maps.now === null) return {};
      const before = maps.now.info.energy;
      maps.become(maps.now.improve(), number);
      return { before, ...picture({ source, target, compare }) };
    },

    /** Where points come from, or go to. */
    'cage.points'({ points, forth }) {
      if (maps.now === null) return { points: [] };
      return { points: forth ? maps.now.apply(points) : maps.now.inverse(points) };
    },

    'cage.warp'({ picture: from, width, height }) {
      const to = { width, height, data: new Uint8ClampedArray(4 * width * height) };
      maps.now.warp(from, to);
      return { pixels: to.data };
    },
  };
}
