// Outlines that do not correspond. See icc_match_create().
import { Handle, flat } from './core.js';
import { withDomains } from './domain.js';

const ADDED = 0xffffffff;

/** The class Match of an instance. */
export function matchOf(core, Domain) {
  return class Match extends Handle {
    /** source, target: Domains of the plane, or outlines, or surfaces; landmarks: rows of a point of the source and one of the
     *  target; options as in icc_match_options. new Map(match.source, match.target) maps them. */
    constructor(source, target, landmarks = [], options = null) {
      const given = flat(landmarks);
      const dim = source instanceof Domain ? source.info.dim : 2;
      super(core, null, () => withDomains(Domain, { source, target }, (s, t) =>
        core.call('icc_match_create', s, t, given.length / (2 * dim), given, options)), 'icc_match_free');
    }

    get info() { return core.info('icc_match_get_info', this); }

    /** The domains with common vertices. */
    get source() { return new Domain(core.made('icc_match_source', this), this); }
    get target() { return new Domain(core.made('icc_match_target', this), this); }

    /** For every common vertex its number in the domains that were given: { source, target }; -1: it was added. */
    origins() {
      const { nVertices } = this.info;
      const source = new Uint32Array(nVertices), target = new Uint32Array(nVertices);
      core.call('icc_match_get_origins', this, source, target);
      const numbers = (given) => Int32Array.from(given, (vertex) => (vertex === ADDED ? -1 : vertex));
      return { source: numbers(source), target: numbers(target) };
    }
  };
}
