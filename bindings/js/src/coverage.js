// Two layers of regions that share borders. See icc_coverage_create().
import { Handle } from './core.js';
import { IccError } from './error.js';
import { ring } from './points.js';

const isNumbers = (list) => typeof list?.[0] === 'number' || typeof list?.[0]?.[0] === 'number' || list?.[0]?.x !== undefined;

/** The polygons of a shape: lists of rings, whose later ones are holes. */
function polygonsOf(shape, name) {
  if (isNumbers(shape)) return [[shape]];
  if (Array.isArray(shape)) return [shape];
  if (shape?.type === 'Polygon') return [shape.coordinates];
  if (shape?.type === 'MultiPolygon') return shape.coordinates;
  throw new TypeError(`region ${name} is neither a ring nor a list of rings, and no Polygon or MultiPolygon of GeoJSON`);
}

/** The regions of a layer, [name, shape]. */
function regionsOf(layer, by) {
  if (layer?.type !== 'FeatureCollection') {
    if (layer instanceof Map) return [...layer];
    if (typeof layer === 'object' && layer !== null) return Object.entries(layer);
    throw new TypeError(`a layer is an object or a Map of regions, or a FeatureCollection, not ${String(layer)}`);
  }
  return layer.features.map((feature) => {
    const name = by === null ? feature.id : feature.properties?.[by];
    if (name === undefined || name === null)
      throw new TypeError(`a feature has no ${by === null ? "member 'id'" : `property '${by}'`}`);
    return [name, feature.geometry];
  });
}

/** An icc_layer. `number` gives the number of a region's name. */
function layerOf(regions, number) {
  const rings = [], ids = [], holes = [];
  for (const [name, shape] of regions)
    for (const polygon of polygonsOf(shape, name))
      polygon.forEach((points, k) => {
        rings.push(ring(points));
        ids.push(BigInt(number.get(name)));
        holes.push(k > 0 ? 1 : 0);
      });
  const first = [0];
  for (const one of rings) first.push(first.at(-1) + one.length / 2);
  const vertices = new Float64Array(2 * first.at(-1));
  rings.forEach((one, k) => vertices.set(one, 2 * first[k]));
  return { nRings: rings.length, first, vertices, ids: BigInt64Array.from(ids), holes: Uint8Array.from(holes) };
}

/** A message with names instead of the numbers of regions. */
const withNames = (message, names) => message.replace(/\bregions? \d+(?: and \d+)?/g,
  (found) => found.replace(/\d+/g, (number) => names[Number(number)]));

/** The class Coverage of an instance. */
export function coverageOf(core, Domain) {
  return class Coverage extends Handle {
    #names;

    /** source, target: layers. A layer is an object or a Map of names and shapes, or a FeatureCollection, in which the
     *  property `by`, or else `id`, has the names. A shape is a ring, a list of rings whose later ones are holes, or a
     *  Polygon or MultiPolygon. options: { by, weld, unmatched, leftOut, between }. */
    constructor(source, target, { by = null, weld = 0, unmatched, leftOut = [], between } = {}) {
      const layers = [source, target].map((layer) => regionsOf(layer, by));
      const names = [...new Set([...layers.flat().map(([name]) => name), ...leftOut])];
      const number = new Map(names.map((name, k) => [name, k]));
      const gone = BigInt64Array.from(leftOut, (name) => BigInt(number.get(name)));
      super(core, null, () => {
        try {
          return core.call('icc_coverage_create', ...layers.map((layer) => layerOf(layer, number)), {
            weld: typeof weld === 'number' ? [weld, weld] : weld, unmatched, between, nLeftOut: gone.length, leftOut: gone,
          });
        } catch (error) {
          if (error instanceof IccError) error.message = withNames(error.message, names);
          throw error;
        }
      }, 'icc_coverage_free');
      this.#names = names;
    }

    get dim() { return 2; }

    /** The members of icc_coverage_info. Of arrays, the first half belongs to the source. */
    get info() { return core.info('icc_coverage_get_info', this); }

    /** The domains with common vertices, whose features are the rings: new Map(coverage.source, coverage.target). */
    get source() { return new Domain(core.made('icc_coverage_source', this), this); }
    get target() { return new Domain(core.made('icc_coverage_target', this), this); }

    /** The name of each ring's region. */
    get regions() {
      const ids = new BigInt64Array(this.info.nFeatures);
      core.call('icc_coverage_get_ids', this, ids);
      return Array.from(ids, (id) => this.#names[Number(id)]);
    }

    /** The rings with their vertices in both layers: [{ region, hole, source, target }]. */
    get rings() {
      const regions = this.regions, [source, target] = [this.source, this.target].map((domain) => domain.boundary().vertices);
      return this.source.features().map(({ kind, firstVertex, nVertices }, k) => {
        const range = [2 * firstVertex, 2 * (firstVertex + nVertices)];
        return { region: regions[k], hole: kind === 'hole', source: source.slice(...range), target: target.slice(...range) };
      });
    }

    /** What only one layer has: [{ kind, side, regions, place }]. */
    get differences() {
      return Array.from({ length: this.info.nDifferences }, (_, k) => {
        const { kind, side, nIds, ids, place } = core.info('icc_coverage_get_difference', this, k);
        const regions = ids.slice(0, nIds).map((id) => this.#names[id]);
        return { kind, side: side === 1 ? 'source' : 'target', regions, place };
      });
    }
  };
}
