// Charts: coordinates of the inside of a domain, a boundary point and a share of the way. See
// icc_chart_create().
import { Handle } from './core.js';
import { exactly, flat, onePoint, withPoint } from './points.js';
import { withDomains } from './domain.js';

/** The infos that only charts of one method have. Charts of other methods refuse them. */
const INFOS = {
  gradient: ['icc_chart_get_gradient_info'], field: ['icc_chart_get_field_info'],
  foliation: ['icc_chart_get_foliation_info', 'icc_chart_get_shelling_info'],
  disc: ['icc_chart_get_disc_info'],
};

/** The class Chart of an instance. */
export function chartOf(core, Domain) {
  return class Chart extends Handle {
    /** domain: a Domain, or an outline; options as in icc_chart_options: { method: 'disc', ... }. */
    constructor(domain, options = null, lender = null) {
      super(core, domain, () => withDomains(Domain, { domain }, (d) =>
        core.call('icc_chart_create', d, withPoint(options, 'maximum', d.dim))),
        'icc_chart_free', lender);
    }

    /** The chart of method gradient whose curves follow a GridFunction, on the library's stages or your own. */
    static fromFunction(gridFunction) { return new Chart(core.made('icc_chart_create_function', gridFunction)); }

    static load(bytes) { return new Chart(core.made('icc_chart_load', bytes.length, bytes)); }
    save() { return core.save('icc_chart_save', this); }

    get info() { return core.info('icc_chart_get_info', this); }
    get timings() { return core.info('icc_chart_get_timings', this); }
    get certified() { return this.info.certified === 1; }
    get domain() { return new Domain(core.made('icc_chart_domain', this), this); }

    /** What only charts of this method have. */
    get details() {
      const names = INFOS[this.info.method];
      return core.info(names[this.dim === 2 && this.domain.info.nMeshSimplices === 0 ? 0 : names.length - 1], this);
    }

    /** Estimates what the coordinates miss, from about nPoints points. */
    report(nPoints = 0) { return core.info('icc_chart_get_report', this, nPoints); }

    /** Computes the coordinates of points: { facet, bary, t, status }. With { flags: true } also `flags`, which is 0
     *  for points that decode() brings back, else a sum of ICC_LOSS_*. */
    encode(points, { flags = false } = {}) {
      const { dim } = this, p = flat(points, dim), n = p.length / dim;
      const out = {
        facet: new Uint32Array(n), bary: new Float64Array(n * dim), t: new Float64Array(n),
        status: new Int32Array(n),
      };
      if (flags) out.flags = new Int32Array(n);
      core.call('icc_chart_encode_flags', this, n, p, out.facet, out.bary, out.t, out.status, out.flags ?? null, null);
      return out;
    }

    /** Computes the points of coordinates: { points, status }. With { flags: true } also `flags`, which is 0 for
     *  coordinates that encode() returns, else a sum of ICC_LOSS_*. */
    decode({ facet, bary, t }, { flags = false } = {}) {
      const n = t?.length;
      exactly(t, n, 't');
      exactly(facet, n, 'facet');
      exactly(bary, n * this.dim, 'bary');
      const out = { points: new Float64Array(n * this.dim), status: new Int32Array(n) };
      if (flags) out.flags = new Int32Array(n);
      core.call('icc_chart_decode_flags', this, n, facet, bary, t, out.points, out.status, out.flags ?? null, null);
      return out;
    }

    /** The curve through a point, from the boundary to the maximum: flat coordinates. */
    trace(point) {
      const p = onePoint(point, this.dim), count = new Uint32Array(1);
      core.call('icc_chart_trace', this, p, 0, null, count);
      const curve = new Float64Array(count[0] * this.dim);
      core.call('icc_chart_trace', this, p, count[0], curve, count);
      return curve;
    }
  };
}
