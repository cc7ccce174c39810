// Domains: a boundary and what it encloses. See icc_domain_create() and the functions after it.
import { Handle } from './core.js';
import { IccError } from './error.js';
import { isGeoJson, shapeOf } from './geojson.js';
import { constantNames } from './names.js';
import { exactly, flat, indices, meshOf, ring, sidesOf, whole } from './points.js';

const DEFECTS = constantNames('ICC_DEFECT_');

const feature = (kind, points, radius = 0) => {
  const vertices = kind === 'hole' || kind === 'region' ? ring(points) : flat(points, 2);
  return { kind, nVertices: vertices.length / 2, vertices, radius };
};

/** The features of a shape, in the order regions, holes, lines, points. */
function featuresOf({ regions = [], holes = [], lines = [], points = [], radii = [] }) {
  const rings = [...regions.map((region) => feature('region', region)), ...holes.map((hole) => feature('hole', hole))];
  return [...rings, ...lines.map((line) => feature('line', line)),
    ...points.map((point, i) => feature('point', point, radii[i] ?? 0))];
}

const solidFeature = (kind, points) => {
  const vertices = flat(points, 3);
  return { kind, nVertices: vertices.length / 3, vertices, radius: 0 };
};

const innerSurface = (kind, { vertices, facets }) => {
  const f = indices(facets, 3);
  return { ...solidFeature(kind, vertices), nFacets: f.length / 3, facets: f };
};

/** The features of a solid, in the order voids, surfaces, lines, points. */
function solidFeaturesOf({ voids = [], surfaces = [], lines = [], points = [] }) {
  return [...voids.map((surface) => innerSurface('hole', surface)),
    ...surfaces.map((surface) => innerSurface('region', surface)), ...lines.map((line) => solidFeature('line', line)),
    ...points.map((point) => solidFeature('point', point))];
}

/** Makes a polygon that the caller frees. If its name is that of a side, errors name that side. */
function polygonOf(Domain, name, shape) {
  if (typeof shape !== 'object' || shape === null)
    throw new TypeError(`${name} is ${shape}, but has to be a Domain or an outline`);
  try {
    return Domain.polygon(shape);
  } catch (error) {
    if (name !== 'source' && name !== 'target') throw error;
    throw error instanceof IccError ? error.blame(name) : new TypeError(`${name}: ${error.message}`);
  }
}

/** Runs `work` with shapes, given by name. Domains are passed as they are. Outlines become polygons, freed afterwards. */
export function withDomains(Domain, shapes, work) {
  const made = [];
  try {
    return work(...Object.entries(shapes).map(([name, shape]) => {
      if (shape instanceof Handle) return shape;
      made.push(polygonOf(Domain, name, shape));
      return made.at(-1);
    }));
  } finally {
    for (const domain of made) domain.free();
  }
}

/** The class Domain of an instance. */
export function domainOf(core) {
  return class Domain extends Handle {
    constructor(address, lender = null) {
      const none = () => { throw new TypeError('Domains are made by Domain.polygon(), surface(), mesh() and mask()'); };
      super(core, address, none, 'icc_domain_free', lender);
    }

    /** A simple polygon with features: { regions, holes, lines, points, radii }. The outline may be null if there are
     *  regions. It may be a polygon of GeoJSON, which has holes and regions of its own; given ones come after them. */
    static polygon(outline, features = {}) {
      if (isGeoJson(outline)) {
        const { outline: outer, regions, holes } = shapeOf(outline);
        return Domain.polygon(outer, { ...features, regions: [...regions, ...features.regions ?? []],
          holes: [...holes, ...features.holes ?? []] });
      }
      const outer = outline === null ? new Float64Array() : ring(outline);
      const inside = featuresOf(features);
      return new Domain(inside.length === 0
        ? core.made('icc_domain_create', 2, outer.length / 2, outer, 0, null)
        : core.made('icc_domain_create_features', outer.length / 2, outer, inside.length, inside));
    }

    /** A boundary of facets, `dim` vertices each: in space a closed surface of triangles. */
    static surface(vertices, facets, dim = 3) {
      const v = flat(vertices, dim), f = indices(facets, dim);
      return new Domain(core.made('icc_domain_create', dim, v.length / dim, v, f.length / dim, f));
    }

    /** A solid with features: { voids, surfaces, lines, points }. Voids and surfaces are closed: { vertices, facets }. */
    static solid(vertices, facets, features = {}) {
      const v = flat(vertices, 3), f = indices(facets, 3), inside = solidFeaturesOf(features);
      return new Domain(core.made('icc_domain_create_solid', v.length / 3, v, f.length / 3, f, inside.length, inside));
    }

    /** A conforming mesh of the inside. `facets` may give the order of the boundary's facets. */
    static mesh(vertices, simplices, { dim = 3, facets = null } = {}) {
      const v = flat(vertices, dim), s = indices(simplices, dim + 1);
      const f = facets === null ? null : indices(facets, dim);
      return new Domain(core.made('icc_domain_create_mesh', meshOf(dim, v, s), f === null ? 0 : f.length / dim, f));
    }

    /** A mask of cells: `shape` cells along the axes, the first axis fastest. */
    static mask(shape, cells) {
      const { sides, n } = sidesOf(shape);
      return new Domain(core.made('icc_domain_create_mask', sides.length, sides, exactly(cells, n, 'cells')));
    }

    get info() { return core.info('icc_domain_get_info', this); }

    /** Fills this surface in space with tetrahedra; options { ratio, maxPoints }. */
    fill(options = null) { return new Domain(core.made('icc_domain_fill', this, options)); }

    /** The boundary as it was given, with the vertices of all features: { vertices, facets }. */
    boundary() {
      const { dim, nVertices, nFacets } = this.info;
      const out = { vertices: new Float64Array(nVertices * dim), facets: new Uint32Array(nFacets * dim) };
      core.call('icc_domain_get_boundary', this, out.vertices, out.facets);
      return out;
    }

    /** The mesh of the inside, if it has one: { vertices, simplices }. */
    mesh() {
      const { dim, nMeshVertices, nMeshSimplices } = this.info;
      const out = {
        vertices: new Float64Array(nMeshVertices * dim),
        simplices: new Uint32Array(nMeshSimplices * (dim + 1)),
      };
      core.call('icc_domain_get_mesh', this, meshOf(dim, out.vertices, out.simplices));
      return out;
    }

    /** The region of each simplex of mesh(): 0, or k within the k-th surface of a solid. */
    meshRegions() {
      const regions = new Uint32Array(this.info.nMeshSimplices);
      core.call('icc_domain_get_regions', this, regions);
      return regions;
    }

    /** The features inside: [{ kind, orientation, firstVertex, nVertices, firstFacet, nFacets, genus, around }]. */
    features() {
      return Array.from({ length: this.info.nFeatures }, (_, i) => core.info('icc_domain_get_feature', this, i));
    }

    /** Reports where points lie: { where, facet, bary }. `where` is 1 inside, 2 on the boundary, 3 outside. `facet`
     *  is the nearest facet, and `bary` has the barycentric coordinates of the nearest point on it. */
    locate(points) {
      const { dim } = this, p = flat(points, dim), n = p.length / dim;
      const out = { where: new Int32Array(n), facet: new Uint32Array(n), bary: new Float64Array(n * dim) };
      core.call('icc_domain_locate', this, n, p, out.where, out.facet, out.bary);
      return out;
    }
  };
}

/** Functions about boundaries and masks. */
export function shapesOf(core) {
  return {
    /** Lists all defects that keep a closed polygon from being a boundary: [{ kind, a, b }]. */
    boundaryDefects(outline) {
      const p = ring(outline), count = new Uint32Array(1);
      core.call('icc_boundary_defects', p.length / 2, p, 0, null, null, count);
      const kinds = new Int32Array(count[0]), items = new Uint32Array(2 * count[0]);
      core.call('icc_boundary_defects', p.length / 2, p, count[0], kinds, items, count);
      return Array.from(kinds, (kind, i) => (
        { kind: DEFECTS.get(kind).toLowerCase(), a: items[2 * i], b: items[2 * i + 1] }));
    },

    /** Repairs a mask in which cells touch only at an edge or a corner. Returns the number of filled cells. */
    repairMask(shape, cells) {
      const filled = new Uint32Array(1), { sides, n } = sidesOf(shape);
      core.call('icc_mask_repair', sides.length, sides, exactly(cells, n, 'cells'), filled);
      return filled[0];
    },

    /** A constrained Delaunay triangulation of a simple polygon and points inside it. */
    triangulate(nBoundary, points) {
      const p = flat(points, 2), n = p.length / 2;
      const triangles = new Uint32Array(Math.max(0, 3 * (2 * n - 2 - whole(nBoundary, 0, 'nBoundary'))));
      core.call('icc_triangulate', nBoundary, n, p, triangles);
      return triangles;
    },
  };
}
