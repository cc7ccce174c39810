// Outlines that do not correspond. See icc_match_create().
import { Handle, optional, room } from './core.js';
import { withDomains } from './domain.js';
import { flat } from './points.js';

const ADDED = 0xffffffff;

/** The class Match of an instance. */
export function matchOf(core, Domain) {
  return class Match extends Handle {
    /** source, target: Domains of the plane, outlines or surfaces. landmarks: rows of a point of the source and its
     *  partner in the target. options as in icc_match_options. new Map(match.source, match.target) maps them. */
    constructor(source, target, landmarks = [], options = null) {
      const given = flat(landmarks);
      const dim = source instanceof Domain ? source.info.dim : 2;
      if (given.length % (2 * dim) !== 0)
        throw new TypeError(`${given.length} numbers are no landmarks of ${2 * dim} each: a point and its partner`);
      super(core, source, () => withDomains(Domain, { source, target }, (s, t) =>
        core.call('icc_match_create', s, t, given.length / (2 * dim), given, options)), 'icc_match_free');
    }

    static load(bytes) { return new Match(core.made('icc_match_load', bytes.length, bytes)); }
    save() { return core.save('icc_match_save', this); }

    get info() { return core.info('icc_match_get_info', this); }

    /** The domains with common vertices. */
    get source() { return new Domain(core.made('icc_match_source', this), this); }
    get target() { return new Domain(core.made('icc_match_target', this), this); }

    /** For every common vertex its number in the given domains: { source, target }; -1: it was added. */
    origins() {
      const { nVertices } = this.info;
      const source = new Uint32Array(nVertices), target = new Uint32Array(nVertices);
      core.call('icc_match_get_origins', this, source, target);
      const numbers = (given) => Int32Array.from(given, (vertex) => (vertex === ADDED ? -1 : vertex));
      return { source: numbers(source), target: numbers(target) };
    }

    /** Takes points of the source's boundary to the target's. `out` receives them, `off` their distances from the common
     *  boundary. */
    apply(points, { out, off = null } = {}) { return this.#follow('icc_match_apply', points, out, off); }

    /** Target to source. */
    inverse(points, { out, off = null } = {}) { return this.#follow('icc_match_apply_inverse', points, out, off); }

    #follow(name, points, out, off) {
      const p = flat(points, this.dim), result = room(out, p.length);
      core.call(name, this, p.length / this.dim, p, result, optional(off, p.length / this.dim, 'off'));
      return result;
    }
  };
}
