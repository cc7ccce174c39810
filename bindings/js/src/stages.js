// The stages of Integral Curve Coordinates one by one: grid, tree, function, curves. See icc/stages.h.
import { Handle } from './core.js';
import { exactly, flat, onePoint, sidesOf } from './points.js';
import { Address } from './memory.js';
import { constantNames, constantOf } from './names.js';

/** The classes Grid, Tree, GridFunction and Curves of an instance. */
export function stagesOf(core) {
  const copied = (Type, address, n) => (address === 0 ? null : core.memory.array(Type, address, n).slice());

  const withAxes = (options, grid) => (options?.axisOrder
    ? { ...options, axisOrder: exactly(options.axisOrder, grid.info.dim, 'axisOrder') } : options);
  const ofVertices = (tree, values, what) => Float64Array.from(exactly(values, tree.grid.info.nVertices, what));

  class Grid extends Handle {
    /** domain: a Domain. cells: number of cells along its longest side. */
    constructor(domain, cells = 0, lender = null) {
      super(core, domain, () => core.call('icc_grid_create', domain, cells), 'icc_grid_free', lender);
    }

    /** A mask of vertices, the first axis fastest. */
    static mask(shape, inside) {
      const { sides, n } = sidesOf(shape);
      return new Grid(core.made('icc_grid_create_mask', sides.length, sides, exactly(inside, n, 'inside')));
    }

    get info() { return core.info('icc_grid_get_info', this); }
    refine() { return new Grid(core.made('icc_grid_refine', this)); }
    restrict(keep) { return new Grid(core.made('icc_grid_restrict', this, exactly(keep, this.info.nVertices, 'keep'))); }

    /** One byte per vertex, 1 inside. */
    inside() { return copied(Uint8Array, core.call('icc_grid_inside', this), this.info.nVertices); }

    /** The grassfire's maximum: { vertex, rounds }. The fire burnt this many rounds before it reached the vertex. */
    findMaximum() {
      const vertex = new Uint32Array(1), rounds = new Uint32Array(1);
      core.call('icc_grid_find_maximum', this, vertex, rounds);
      return { vertex: vertex[0], rounds: rounds[0] };
    }

    /** Positions of vertices, flat; of all without an argument. */
    points(vertices = null) {
      const { nVertices, dim } = this.info, n = vertices === null ? nVertices : vertices.length;
      const points = new Float64Array(n * dim);
      core.call('icc_grid_get_points', this, n, vertices === null ? null : Uint32Array.from(vertices), points);
      return points;
    }

    findNearest(point) {
      const vertex = new Uint32Array(1);
      core.call('icc_grid_find_nearest', this, onePoint(point, this.info.dim), vertex);
      return vertex[0];
    }
  }

  class Tree extends Handle {
    /** options as in icc_tree_options: { form: 'thesis', axisOrder }. */
    constructor(grid, root, options = null, lender = null) {
      super(core, grid, () => core.call('icc_tree_create', grid, root, withAxes(options, grid)), 'icc_tree_free', lender);
    }

    /** A tree with parents of your own, one number per vertex: 4294967295 for the root and vertices to leave out. */
    static fromParents(grid, root, parents, options = null) {
      const given = Uint32Array.from(exactly(parents, grid.info.nVertices, 'parents'));
      return new Tree(core.made('icc_tree_create_parents', grid, root, given, withAxes(options, grid)), root);
    }

    get grid() { return new Grid(core.made('icc_tree_grid', this), 0, this); }
    get root() { return core.call('icc_tree_root', this) >>> 0; }
    get #n() { return this.grid.info.nVertices; }

    /** The parent of each vertex; 4294967295 for those without. */
    parents() { return copied(Uint32Array, core.call('icc_tree_parents', this), this.#n); }
    generations() { return copied(Int32Array, core.call('icc_tree_generations', this), this.#n); }
    report() { return core.info('icc_tree_get_report', this); }

    /** Orders the vertices so that the root is the only critical one: { rank, report }. */
    grow(values = null) {
      const rank = new Uint32Array(this.#n), report = {};
      core.call('icc_tree_grow', this, values === null ? null : exactly(values, rank.length, 'values'), rank, report);
      return { rank, report };
    }

    rankReport(rank) { return core.info('icc_tree_get_rank_report', this, exactly(rank, this.#n, 'rank')); }
  }

  class GridFunction extends Handle {
    /** options as in icc_function_options: { function: 'laplace', constraints: 'all', ... }. */
    constructor(tree, options = null, lender = null) {
      super(core, tree, () => core.call('icc_function_create', tree, options), 'icc_function_free', lender);
    }

    /** A function with values of your own, one per vertex; NaN outside lets it go on as it falls inside. */
    static fromValues(tree, values) {
      return new GridFunction(core.made('icc_function_create_values', tree, ofVertices(tree, values, 'values')));
    }

    /** The same from natural logarithms, for values that doubles cannot hold. */
    static fromLogs(tree, logs) {
      return new GridFunction(core.made('icc_function_create_logs', tree, ofVertices(tree, logs, 'logs')));
    }

    /** Solves an equation with fixed values (NaN: free) and a right-hand side, one number per vertex, or null. */
    static solve(tree, options = null, fixed = null, rightSide = null) {
      const numbers = (given) => given && Float64Array.from(given);
      return new GridFunction(core.made('icc_function_create_solve', tree, options, numbers(fixed), numbers(rightSide)));
    }

    /** The function of a chart of method gradient or field, or null. */
    static ofChart(chart) {
      const address = core.call('icc_chart_function', chart);
      return address === 0 ? null : new GridFunction(new Address(address), null, chart);
    }

    get info() { return core.info('icc_function_get_info', this); }
    /** How the function was computed: icc_solver_report. */
    get solverReport() { return core.info('icc_function_get_solver_report', this); }
    get tree() { return new Tree(core.made('icc_function_tree', this), 0, null, this); }
    get #n() { return this.tree.grid.info.nVertices; }

    values() { return copied(Float64Array, core.call('icc_function_values', this), this.#n); }
    logs() { return copied(Float64Array, core.call('icc_function_logs', this), this.#n); }
    report() { return core.info('icc_function_get_report', this); }

    /** Compression (1) and expansion (2) edges in the plane: { edges, kinds, tested }. */
    edges() {
      const count = new Uint32Array(1), tested = new Uint32Array(1);
      core.call('icc_function_get_edges', this, 0, null, null, count, tested);
      const edges = new Uint32Array(2 * count[0]), kinds = new Int32Array(count[0]);
      core.call('icc_function_get_edges', this, count[0], edges, kinds, count, tested);
      return { edges, kinds, tested: tested[0] };
    }

    /** The same in any dimension: { facets, kinds, report }, with dim vertices a facet. */
    facets() {
      const report = {}, { dim } = this.tree.grid.info;
      core.call('icc_function_get_facets', this, 0, null, null, report);
      const n = report.nCompression + report.nExpansion;
      const facets = new Uint32Array(n * dim), kinds = new Int32Array(n);
      core.call('icc_function_get_facets', this, n, facets, kinds, report);
      return { facets, kinds, report };
    }

    /** Only counts these facets: icc_facet_report. */
    facetReport() {
      const report = {};
      core.call('icc_function_get_facets', this, 0, null, null, report);
      return report;
    }
  }

  class Curves extends Handle {
    /** The integral curves of a function through points; way: 'up' or 'down'. */
    constructor(gridFunction, points, way = 'up', lender = null) {
      super(core, gridFunction, () => {
        const { dim } = gridFunction.tree.grid.info, p = flat(points, dim);
        return core.call('icc_curves_create', gridFunction, p.length / dim, p, constantOf('ICC_WAY_', way));
      }, 'icc_curves_free', lender);
    }

    get info() { return core.info('icc_curves_get_info', this); }

    /** Flat coordinates of each curve, beginning with its point. */
    vertices() {
      const { nCurves, nVertices, dim } = this.info;
      const first = new Uint32Array(nCurves + 1), all = new Float64Array(nVertices * dim);
      core.call('icc_curves_get_vertices', this, first, all);
      return Array.from({ length: nCurves }, (_, i) => all.slice(dim * first[i], dim * first[i + 1]));
    }

    /** How they end: { end, length, alone, facet, bary }, arrays with an entry for each curve. */
    ends() {
      const { nCurves: n, dim } = this.info;
      const out = { end: new Int32Array(n), length: new Float64Array(n), alone: new Float64Array(n),
        facet: new Uint32Array(n), bary: new Float64Array(n * dim) };
      core.call('icc_curves_get_ends', this, out.end, out.length, out.alone, out.facet, out.bary);
      const names = constantNames('ICC_END_');
      return { ...out, end: Array.from(out.end, (end) => names.get(end).toLowerCase()) };
    }
  }

  return { Grid, Tree, GridFunction, Curves };
}
