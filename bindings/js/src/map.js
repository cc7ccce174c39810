// Maps from one domain to another. See icc_map_create().
import { Handle, optional, room } from './core.js';
import { withDomains } from './domain.js';
import { moved } from './geojson.js';
import { Address } from './memory.js';
import { exactly, flat, indices, meshOf, whole, withPoint } from './points.js';

const CHANNELS = 4; // of ImageData: red, green, blue, opacity

/** Turns a picture like ImageData into an icc_picture. Refuses one whose pixels are not those of its size, because C
 *  reads and writes as many bytes as the size says. */
function picture(given, what) {
  if (typeof given !== 'object' || given === null) throw new TypeError(`${what} is ${given}, but has to be like ImageData`);
  const { width, height, data } = given;
  whole(width, 1, `${what}.width`);
  whole(height, 1, `${what}.height`);
  if (!(data instanceof Uint8Array || data instanceof Uint8ClampedArray))
    throw new TypeError(`${what}.data must be a Uint8ClampedArray or a Uint8Array`);
  const needed = CHANNELS * width * height;
  if (data.length !== needed)
    throw new TypeError(`${what}.data has ${data.length} bytes, but ${width} x ${height} pixels of RGBA are ${needed}`);
  return { width, height, channels: CHANNELS, bytes: 1, alpha: 1, stride: CHANNELS * width, pixels: bytesOf(data) };
}
const bytesOf = (data) => new Uint8Array(data.buffer, data.byteOffset, data.byteLength);

const OUTSIDE = ['nan', 'identity', 'nearest'];

/** The number of values of a grid. */
function sampleCount({ shape }) {
  if (shape.length !== 2 && shape.length !== 3) throw new TypeError('a grid has two or three axes');
  return shape.reduce((n, side) => n * whole(side, 2, 'shape'), shape.length);
}

/** An icc_field. `step` has one vector for each axis. */
function fieldOf(field, outside) {
  const { shape, origin, step, displacement, values } = field, dim = shape.length, n = sampleCount(field);
  const data = exactly(values instanceof Float32Array ? values : flat(values, dim), n, 'values');
  const padded = (array, length, least, what) => [...exactly(flat(array, dim), least, what), ...Array(length - least).fill(0)];
  if (!OUTSIDE.includes(outside)) throw new TypeError(`outside is ${outside}; it must be one of ${OUTSIDE}`);
  return { dim, bytes: data.BYTES_PER_ELEMENT, displacement: displacement ? 1 : 0, outside: OUTSIDE.indexOf(outside) + 1,
    shape: [...shape, ...Array(3 - dim).fill(0)], origin: padded(origin, 3, dim, 'origin'), step: padded(step, 9, dim * dim, 'step'),
    values: bytesOf(data) };
}

/** Proves that a sampled field does not fold: certifyField() of an instance. */
export const certifierOf = (core) => (field, most = 1000) => {
  const cells = new Uint32Array(most), kinds = new Int32Array(most), report = {};
  core.call('icc_field_certify', fieldOf(field, 'nan'), most, cells, kinds, report);
  const n = Math.min(most, report.nFolded + report.nUndecided + report.nMissing);
  return { ...report, cells: cells.slice(0, n), kinds: Array.from(kinds.slice(0, n), (kind) => CELLS[kind - 1]) };
};
const CELLS = ['folded', 'undecided', 'missing'];

/** The class Map of an instance. */
export function mapOf(core, Domain, Chart) {
  class Map extends Handle {
    /** source, target: Domains, or outlines; options as in icc_map_options: { kind: 'mesh', chart: {...} }. */
    constructor(source, target, options = null, lender = null) {
      super(core, source, () => withDomains(Domain, { source, target },
        (s, t) => core.call('icc_map_create', s, t, checked(options, s.dim))), 'icc_map_free', lender);
    }

    static fromCharts(source, target, options = null) {
      return new Map(core.made('icc_map_create_from_charts', source, target, checked(options, source.dim)));
    }

    /** The one-to-one map that is nearest to a warp of a mesh in the plane, given by the images of its vertices. The images
     *  of the boundary and of the vertices `held` do not change. Returns { map, report }. */
    static nearest(vertices, simplices, images, held = []) {
      const v = flat(vertices, 2), numbers = indices(held), report = {};
      const map = new Map(core.made('icc_map_create_nearest', meshOf(2, v, indices(simplices, 3)),
        exactly(flat(images, 2), v.length, 'images'), { nHeld: numbers.length, held: numbers }, report));
      return { map, report };
    }

    static load(bytes) { return new Map(core.made('icc_map_load', bytes.length, bytes)); }
    save() { return core.save('icc_map_save', this); }

    /** The members of icc_map_info. */
    get info() { return core.info('icc_map_get_info', this); }
    /** How the map was made: icc_map_report. */
    get report() { return core.info('icc_map_get_report', this); }
    get certified() { return this.info.certified === 1; }
    get sourceChart() { return this.#chart('icc_map_source_chart'); }
    get targetChart() { return this.#chart('icc_map_target_chart'); }

    #chart(name) {
      const address = core.call(name, this);
      return address === 0 ? null : new Chart(new Address(address), null, this);
    }

    /** Makes a map of lower distortion from a mesh map; options { iterations, levels, tolerance }. */
    improve(options = null) { return new Map(core.made('icc_map_improve', this, options, null)); }

    /** Makes the map to a target that has moved, with at most this many improvement steps. */
    retarget(target, iterations = 0) {
      return withDomains(Domain, { target }, (t) => new Map(core.made('icc_map_retarget', this, t, { iterations })));
    }

    /** The mesh of a mesh map: { vertices, images, simplices }. */
    mesh() {
      const { dim, nVertices, nSimplices } = this.info;
      const out = {
        vertices: new Float64Array(nVertices * dim), images: new Float64Array(nVertices * dim),
        simplices: new Uint32Array(nSimplices * (dim + 1)),
      };
      core.call('icc_map_get_mesh', this, meshOf(dim, out.vertices, out.simplices), out.images);
      return out;
    }

    /** The region of each simplex of mesh(): k within the k-th region of the source, but not in a region inside it; else 0. */
    meshRegions() {
      const regions = new Uint32Array(this.info.nSimplices);
      core.call('icc_map_get_regions', this, regions);
      return regions;
    }

    /** The mesh of a mesh map in the plane as a triangulation for PROJ (+proj=tinshift), in JSON. It records the names of
     *  reference systems, { sourceCrs: 'EPSG:2056', targetCrs }. */
    toProj({ sourceCrs, targetCrs } = {}) {
      if (this.dim !== 2)
        throw new RangeError(`PROJ's triangulations are of the plane; this map has dimension ${this.dim}`);
      const { vertices, images, simplices } = this.mesh();
      const rows = (values, width) => Array.from({ length: values.length / width },
        (_, i) => [...values.subarray(width * i, width * (i + 1))]);
      const to = rows(images, 2);
      return JSON.stringify({
        file_type: 'triangulation_file', format_version: '1.1', publisher: `libicc ${core.memory.string(core.call('icc_version'))}`,
        input_crs: sourceCrs, output_crs: targetCrs,
        transformed_components: ['horizontal'], fallback_strategy: 'none',
        vertices_columns: ['source_x', 'source_y', 'target_x', 'target_y'],
        triangles_columns: ['idx_vertex1', 'idx_vertex2', 'idx_vertex3'],
        vertices: rows(vertices, 2).map((from, i) => [...from, ...to[i]]), triangles: rows(simplices, 3),
      });
    }

    /** Maps points from the source to the target; NaN where there is no image. `out` receives the images, `status` a
     *  status for each point. */
    apply(points, { out, status = null } = {}) { return this.#points('icc_map_apply', points, out, status, 1); }

    /** Maps points from the target to the source. */
    inverse(images, { out, status = null } = {}) {
      return this.#points('icc_map_apply_inverse', images, out, status, 1);
    }

    /** An object of GeoJSON with its positions mapped; options { segment, inverse }. See geojson.js. */
    geojson(object, { segment, inverse = false } = {}) {
      return moved(object, (points) => (inverse ? this.inverse(points) : this.apply(points)), segment);
    }

    /** Derivatives at points, dim * dim numbers each. */
    jacobian(points, { out, status = null } = {}) {
      return this.#points('icc_map_jacobian', points, out, status, this.dim);
    }

    #points(name, points, out, status, width) {
      const p = flat(points, this.dim), result = room(out, p.length * width);
      const n = p.length / this.dim;
      core.call(name, this, n, p, result, optional(status, n, 'status', Int32Array), null);
      return result;
    }

    /** Maps the vertices of a mesh and checks whether the image is a valid mesh: { images, certificate }. */
    certify(vertices, simplices) { return this.#carry('icc_map_certify', vertices, simplices); }

    /** Like certify(), but moves the images of inner vertices until no simplex is inverted. */
    repair(vertices, simplices) { return this.#carry('icc_map_repair', vertices, simplices); }

    #carry(name, vertices, simplices) {
      const { dim } = this, v = flat(vertices, dim), s = indices(simplices, dim + 1);
      const images = new Float64Array(v.length), certificate = {};
      core.call(name, this, meshOf(dim, v, s), images, certificate);
      return { images, certificate };
    }

    /** The ties, which tell on which side features pass one another: [{ vertex: [a, b], source, target, length }], with
     *  the bends in source and target. As the option `ties` they make a map of the same isotopy class. */
    ties() { return Array.from({ length: this.info.nTies }, (_, i) => this.#tie(i)); }

    #tie(i) {
      const info = {};
      core.call('icc_map_get_tie', this, i, info, null, null);
      const source = new Float64Array(2 * info.nSource), target = new Float64Array(2 * info.nTarget);
      core.call('icc_map_get_tie', this, i, info, source, target);
      return { vertex: info.vertex, source, target, length: info.length };
    }

    /** Samples the map on a grid { shape, origin, step }. Returns { field, nOutside }, with a field for certifyField(). */
    sample(grid, { inverse = false, displacement = true, outside = 'nan' } = {}) {
      const values = new Float64Array(sampleCount(grid)), count = new Uint32Array(1);
      const field = { ...grid, displacement, values }, raw = fieldOf(field, outside);
      core.memory.scope(() => {
        const address = core.memory.put('double*', values);
        core.call('icc_map_sample', this, inverse ? 1 : 0, { ...raw, values: new Address(address) }, count);
        values.set(core.memory.array(Float64Array, address, values.length));
      });
      return { field, nOutside: count[0] };
    }

    /** Warps a picture into another one, and returns that. Both are like ImageData: { width, height, data }, with red,
     *  green, blue and opacity. The sizes may differ. Pixel (i, j) covers [i, i+1] x [j, j+1] of the outline's plane.
     *  Pixels of the target that have no image keep their colour. */
    warp(source, target) {
      const from = picture(source, 'source'), to = picture(target, 'target'), { pixels } = to;
      core.memory.scope(() => {
        const address = core.memory.put('uint8_t*', pixels);
        core.call('icc_map_warp', this, from, { ...to, pixels: new Address(address) }, null);
        pixels.set(core.memory.array(Uint8Array, address, pixels.length));
      });
      return target;
    }
  }

  /** The options, with points and ties as C takes them. */
  function checked(options, dim) {
    const given = withTies(withPoint(options, 'targetMaximum', dim));
    return given?.chart ? { ...given, chart: withPoint(given.chart, 'maximum', dim) } : given;
  }

  /** Ties are arrays of { vertex: [a, b], source, target }. */
  function withTies(options) {
    if (!options?.ties) return options;
    const ties = options.ties.map(({ vertex, source = [], target = [] }) => {
      const s = flat(source, 2), t = flat(target, 2);
      return { vertex, nSource: s.length / 2, source: s, nTarget: t.length / 2, target: t };
    });
    return { ...options, nTies: ties.length, ties };
  }
  return Map;
}
