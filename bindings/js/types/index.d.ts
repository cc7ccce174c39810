/// <reference lib="esnext.disposable" />
import type {
  Certificate, ChartInfo, ChartOptions, ChartReport, ChartTimings, CoverageInfo, CurvesInfo, DiscInfo, DomainInfo, FacetReport, FeatureInfo, FieldInfo, FieldReport,
  FillOptions, FitInfo, FitOptions, FoliationInfo, FunctionInfo, FunctionOptions, FunctionReport, GradientInfo, GridInfo, GrowReport, ImproveOptions,
  MapInfo, MapOptions, MapReport, MatchInfo, MatchOptions, NearestReport, SamplingInfo, SamplingOptions, ShellingInfo, SolverReport, TreeOptions,
  TreeReport, WeightsInfo, WeightsOptions, WeightsReport, WeightsTimings,
} from './structs.js';
export * from './structs.js';

/** A point by the names of its coordinates. */
export interface Point { readonly x: number; readonly y: number; readonly z?: number }
/** Rows of coordinates: flat, one array a point, or one object a point. */
export type Points = Float64Array | readonly number[] | readonly (readonly number[])[] | readonly Point[] | Point;
/** Vertex or handle numbers: flat, or in rows. */
export type Indices = Uint32Array | readonly number[] | readonly (readonly number[])[];
/** Pixels as ImageData has them: red, green, blue and opacity, 4 * width * height bytes. */
/** A regular grid. The first axis is the fastest, and `step` has one vector for each axis. */
export interface SampleGrid { shape: readonly number[]; origin: readonly number[]; step: readonly number[] }
/** A map that is sampled on a grid: displacements of the places, or their images. */
export interface SampledField extends SampleGrid { displacement: boolean; values: Float64Array | Float32Array }

export interface Picture { width: number; height: number; data: Uint8ClampedArray | Uint8Array }
export interface Results {
  /** Receives the numbers, in place of a new array. It must have exactly as many. */
  out?: Float64Array;
  /** Receives a status for each point. codeOf() gives its name: 'OK', 'OUTSIDE', ... */
  status?: Int32Array;
}
export type Source = BufferSource | WebAssembly.Module | Response;

/** A call has failed. */
export class IccError extends Error {
  /** The name of the status: 'BOUNDARY', 'CERTIFICATE', 'CANCELLED', ... */
  readonly code: string;
  /** The item at fault, or -1. */
  readonly index: number;
  /** The kind of that item: 'vertex', 'facet', ... or 'none'. */
  readonly item: string;
  /** The shape at fault. */
  readonly side: 'source' | 'target' | null;
}

export interface Handle {
  /** Frees the memory now. Objects that were made from this one stay. */
  free(): void;
  [Symbol.dispose](): void;
}
/** What has a known place. Features are numbered in this order. */
export interface Features {
  /** Polygons that belong to the shape: more outlines, or islands in holes. */
  regions?: readonly Points[];
  holes?: readonly Points[]; lines?: readonly Points[]; points?: readonly Points[]; radii?: readonly number[];
}

/** A boundary and what it encloses. */
export interface Domain extends Handle {
  readonly info: DomainInfo;
  readonly dim: number;
  /** Fills this surface in space with tetrahedra. */
  fill(options?: FillOptions | null): Domain;
  /** The boundary as it was given, with the vertices of all features. */
  boundary(): { vertices: Float64Array; facets: Uint32Array };
  /** The mesh of the inside, if the domain has one. */
  mesh(): { vertices: Float64Array; simplices: Uint32Array };
  /** The region of each simplex of the mesh: 0, or k within the k-th surface of a solid. */
  meshRegions(): Uint32Array;
  features(): FeatureInfo[];
  /** Tells where points lie. `where` is 1 inside, 2 on the boundary, 3 outside. `facet` is the nearest facet, and `bary` has
   *  the barycentric coordinates of the nearest point on it. */
  locate(points: Points): { where: Int32Array; facet: Uint32Array; bary: Float64Array };
}
/** A closed surface of triangles in its own vertices. */
export interface ClosedSurface { vertices: Points; facets: Indices }
/** Features of a solid, numbered in this order. A void is empty inside, a surface is not. */
export interface SolidFeatures {
  voids?: readonly ClosedSurface[];
  surfaces?: readonly ClosedSurface[];
  lines?: readonly Points[];
  points?: readonly Points[];
}
export interface DomainClass {
  /** A simple polygon, which may be a closed ring, with features. The outline may be null if there are regions. It may be a
   *  polygon of GeoJSON, which has holes and regions of its own; given ones come after them. */
  polygon(outline: Points | GeoJson | null, features?: Features): Domain;
  /** A boundary of facets, `dim` vertices each: in space a closed surface of triangles. */
  surface(vertices: Points, facets: Indices, dim?: number): Domain;
  /** A solid with voids, surfaces, lines and points inside. */
  solid(vertices: Points, facets: Indices, features?: SolidFeatures): Domain;
  /** A mesh of the inside. `facets` may give the order of the boundary's facets. */
  mesh(vertices: Points, simplices: Indices, options?: { dim?: number; facets?: Indices | null }): Domain;
  /** A mask of cells: `shape` cells along the axes, the first axis fastest. */
  mask(shape: readonly number[], cells: Uint8Array): Domain;
}
/** An object of GeoJSON, such as a Feature. */
export interface GeoJson { readonly type: string; readonly [member: string]: any }
/** A shape: an outline, or a Polygon or MultiPolygon of GeoJSON, bare or as a Feature. */
export type ShapeLike = Domain | Points | GeoJson;

export interface Coordinates { facet: Uint32Array; bary: Float64Array; t: Float64Array }
/** Coordinates of the inside of a domain: a boundary point and a share of the way to the maximum. */
export interface Chart extends Handle {
  readonly info: ChartInfo;
  readonly timings: ChartTimings;
  readonly dim: number;
  /** What only charts of this method have. */
  readonly details: GradientInfo | FieldInfo | FoliationInfo | ShellingInfo | DiscInfo;
  readonly certified: boolean;
  readonly domain: Domain;
  /** Estimates what the coordinates miss, from about nPoints points. */
  report(nPoints?: number): ChartReport;
  /** The coordinates of points, and with `flags` what is lost at each: 0 or a sum of ICC_LOSS_*. */
  encode(points: Points, options?: { flags?: boolean }): Coordinates & { status: Int32Array; flags?: Int32Array };
  /** The points of coordinates, with `flags` as for encode(). */
  decode(coordinates: Coordinates, options?: { flags?: boolean }): { points: Float64Array; status: Int32Array; flags?: Int32Array };
  /** The curve through a point, from the boundary to the maximum: flat coordinates. */
  trace(point: Points): Float64Array;
  save(): Uint8Array;
}
/** Two outlines with common vertices, made from two that do not correspond. */
export interface Match extends Handle {
  readonly info: MatchInfo;
  readonly source: Domain;
  readonly target: Domain;
  /** For every common vertex its number in the given domains. -1: it was added. */
  origins(): { source: Int32Array; target: Int32Array };
  /** Takes points of the source's boundary to the target's. `off` receives their distances from the common boundary. */
  apply(points: Points, options?: { out?: Float64Array; off?: Float64Array | null }): Float64Array;
  /** Takes points of the target's boundary to the source's. */
  inverse(points: Points, options?: { out?: Float64Array; off?: Float64Array | null }): Float64Array;
  save(): Uint8Array;
}
export interface MatchClass {
  /** landmarks: rows of a point of the source and its partner in the target. */
  new (source: ShapeLike, target: ShapeLike, landmarks?: Points, options?: MatchOptions | null): Match;
  load(bytes: Uint8Array): Match;
}
/** A region: a ring, a list of rings whose later ones are holes, or a Polygon or MultiPolygon of GeoJSON. */
export type RegionShape = Points | readonly Points[] | { readonly type: string; readonly coordinates: any };
/** Regions by name, or a FeatureCollection of GeoJSON. */
export type Layer = { readonly [name: string]: RegionShape } | ReadonlyMap<string | number, RegionShape>
  | { readonly type: 'FeatureCollection'; readonly features: readonly any[] };
export interface CoverageOptions {
  /** Of a FeatureCollection: the property that holds the names. Default: the member `id`. */
  by?: string | null;
  /** Vertices within this length become one, and a vertex within this length of a side becomes part of it. Two numbers: of
   *  the source and of the target. Default 0: only where this is exact. */
  weld?: number | readonly [number, number];
  /** What happens if only one layer has a border: an error names it, or the regions at it are left out. Default: 'refuse'. */
  unmatched?: 'refuse' | 'leave_out';
  /** Names of regions that are left out of both layers. */
  leftOut?: readonly (string | number)[];
  /** How the vertices along a border are paired: by shape or by arc length. Default: 'elastic'. */
  between?: 'elastic' | 'arc';
}
/** Something that only one of two layers has. */
export interface CoverageDifference {
  readonly kind: 'region' | 'border' | 'island';
  /** The layer that has it. */
  readonly side: 'source' | 'target';
  /** The names of the region, or of the regions on both sides of the border. */
  readonly regions: (string | number)[];
  /** A vertex of it, in that layer's coordinates. */
  readonly place: number[];
}
/** Two layers of the same regions, with common vertices. */
export interface Coverage extends Handle {
  readonly info: CoverageInfo;
  readonly dim: number;
  /** The domains with common vertices, whose features are the rings. */
  readonly source: Domain;
  readonly target: Domain;
  /** The name of each ring's region. */
  readonly regions: (string | number)[];
  /** The rings with their vertices in both layers. */
  readonly rings: { region: string | number; hole: boolean; source: Float64Array; target: Float64Array }[];
  /** What only one layer has. */
  readonly differences: CoverageDifference[];
}
export interface CoverageClass {
  new (source: Layer, target: Layer, options?: CoverageOptions): Coverage;
}
export interface ChartClass {
  new (domain: ShapeLike, options?: ChartOptions | null): Chart;
  /** The chart of method gradient whose curves follow a function, on the library's stages or your own. */
  fromFunction(gridFunction: GridFunction): Chart;
  load(bytes: Uint8Array): Chart;
}

export interface Tie { vertex: number[]; source: Float64Array; target: Float64Array; length: number[] }
/** A map from one domain to another. */
export interface Map extends Handle {
  readonly info: MapInfo;
  readonly dim: number;
  /** How the map was made. */
  readonly report: MapReport;
  /** True if the map is proved to be one-to-one. */
  readonly certified: boolean;
  readonly sourceChart: Chart | null;
  readonly targetChart: Chart | null;
  /** A map of lower distortion, from a mesh map. */
  improve(options?: ImproveOptions | null): Map;
  /** The map to a target that has moved, with at most this many improvement steps; 0: as many as a frame has time for. It keeps
   *  the mesh. Make the map anew when the user lets go, if you want the best one. */
  retarget(target: ShapeLike, iterations?: number): Map;
  /** The mesh of a mesh map: places before and after, and the corners of triangles or tetrahedra. */
  mesh(): { vertices: Float64Array; images: Float64Array; simplices: Uint32Array };
  meshRegions(): Uint32Array;
  /** A triangulation for PROJ, in JSON. */
  toProj(systems?: { sourceCrs?: string; targetCrs?: string }): string;
  /** Maps points from the source to the target. A point without an image gets NaN. */
  apply(points: Points, results?: Results): Float64Array;
  /** Maps points from the target to the source. A point without one gets NaN. */
  inverse(images: Points, results?: Results): Float64Array;
  /**
   * A geometry, Feature or FeatureCollection of GeoJSON with its positions mapped. Heights, properties and other members are
   * kept; members `bbox` are left out. Lines get more positions where two are more than `segment` apart. A geometry with a position
   * outside becomes null. Set `inverse` to map from the target to the source.
   */
  geojson<G extends GeoJson>(object: G, options?: { segment?: number; inverse?: boolean }): G;
  /** Derivatives at points, dim * dim numbers each. */
  jacobian(points: Points, results?: Results): Float64Array;
  /** Maps the vertices of a mesh, and checks whether the image is a valid mesh. */
  certify(vertices: Points, simplices: Indices): { images: Float64Array; certificate: Certificate };
  /** Like certify(), but moves the images of inner vertices until no simplex is inverted. */
  repair(vertices: Points, simplices: Indices): { images: Float64Array; certificate: Certificate };
  /** The ties, which tell on which side features pass one another. As the option `ties` they make a map of the same class. */
  ties(): Tie[];
  /**
   * Warps a picture into another one, and returns that. Both have red, green, blue and opacity, as ImageData, and the target may
   * have any size. Pixel (i, j) covers [i, i + 1] x [j, j + 1] of the outline's plane. Pixels without an image keep the target's
   * colour.
   */
  warp<P extends Picture>(source: Picture, target: P): P;
  /** Samples the map, or its inverse, on a grid. Samples without an image get NaN, stay, or move as the nearest boundary point. */
  sample(grid: SampleGrid, options?: { inverse?: boolean; displacement?: boolean; outside?: 'nan' | 'identity' | 'nearest' }):
    { field: SampledField; nOutside: number };
  save(): Uint8Array;
}
export interface MapClass {
  /** Corner i of the source goes to corner i of the target. */
  new (source: ShapeLike, target: ShapeLike, options?: MapOptions | null): Map;
  fromCharts(source: Chart, target: Chart, options?: MapOptions | null): Map;
  /** The one-to-one map that is nearest to a warp of a mesh in the plane, given by the images of its vertices. The images of the
   *  boundary and of the vertices `held` do not change. */
  nearest(vertices: Points, simplices: Indices, images: Points, held?: Indices): { map: Map; report: NearestReport };
  load(bytes: Uint8Array): Map;
}

/** What is known of a map besides its points, and the options of a fit. */
export interface FitInput extends FitOptions {
  /** A mesh of triangles, in place of a domain. It is kept as it is. */
  mesh?: { readonly vertices: Points; readonly simplices: Indices } | null;
  /** Polylines, each before and after. Without a domain and mesh they may share vertices. */
  lines?: readonly (readonly [Points, Points])[];
  /** Vertices of the domain or the mesh, and where they go. */
  vertices?: Indices | null;
  places?: Points | null;
  /** Vertices that may move along a straight line only, and its directions. Without directions they move along the boundary. */
  sliding?: Indices | null;
  along?: Points | null;
  /** Spline: how far the points may be off their targets: one number, or one for each. */
  tolerance?: number | readonly number[] | Float64Array | null;
}
/** A map that is made from what is known of it, such as a few control points. */
export interface Fit extends Handle {
  readonly info: FitInfo;
  readonly dim: number;
  /** The map, which keeps the fit. */
  readonly map: Map;
  /** The image of each item minus its target, 2 numbers each: points first, then lines, vertices and sliding vertices. */
  residuals(): Float64Array;
  /** Where the other points alone would take each point, minus its target; NaN where that is not known. */
  leftOut(): Float64Array;
  /** The fit to targets of all items that have moved. Use it for dragging. */
  move(to: Points): Fit;
}
export interface FitClass {
  /** Points and where they go. Without a domain and a mesh the map covers a box around the points. */
  new (points: Points | null, to?: Points | null, domain?: ShapeLike | null, known?: FitInput | null): Fit;
}

/** Regions and curves that carry kernel coordinates. */
export interface Shape extends Handle { readonly dim: number }
/** The places where weights are computed. */
export interface Sampling extends Handle { readonly info: SamplingInfo; readonly dim: number; points(): Float64Array; save(): Uint8Array }
/** Blending weights of handles: kernel coordinates. */
export interface Weights extends Handle {
  readonly info: WeightsInfo;
  readonly timings: WeightsTimings;
  readonly dim: number;
  /** The places that carry weights. */
  nodes(): { points: Float64Array; initial: Float64Array; values: Float64Array; status: Int32Array };
  /** The weights of all handles at points, point after point. `gradients` receives dim numbers for each. */
  evaluate(points: Points, results?: { out?: Float64Array; gradients?: Float64Array }): Float64Array;
  /** The dual function of a node at points: 1 at the node, 0 at all others, interpolated as weights are. */
  dual(node: number, points: Points, results?: { out?: Float64Array }): Float64Array;
  /** Measures the weights at points. */
  report(points: Points): WeightsReport;
  /** New weights, with a brush applied to the weight of one handle. */
  paint(handle: number, centre: Points, radius: number, amount: number): Weights;
  /** New weights, which start from your own values at some nodes: one for each node and handle. */
  repaint(nodes: Indices, values: Points): Weights;
  /** The weights by another method. */
  withMethod(method: WeightsInfo['method']): Weights;
  /** New weights, with a part that moves as if it were rigid. `energy` is half the sum of its squared derivatives, before and
   *  after. `rigidity` has a positive number for each node. */
  stiffen(nodes: Indices, rigidity?: Float64Array | null): { weights: Weights; energy: Float64Array };
  /** Binds points to the handles, for repeated poses. */
  bind(points: Points, options?: { derivatives?: boolean }): Binding;
}
/** Points with their weights. */
export interface Binding extends Handle {
  readonly info: { nPoints: number; nHandles: number; dim: number };
  readonly dim: number;
  weights(): { handles: Float64Array; weights: Float64Array };
  /** The points under a pose. `jacobians` receives dim * dim numbers for each, if the binding has derivatives. */
  pose(pose: Pose, results?: { out?: Float64Array; jacobians?: Float64Array }): Float64Array;
  save(): Uint8Array;
}
/** A transform for each handle, dim * (dim + 1) numbers, which you may change. */
export interface Pose {
  readonly dim: number;
  readonly handles: Float64Array;
  readonly transforms: Float64Array;
  /** Makes all transforms the identity. */
  reset(): Pose;
  move(handle: number, offset: Points): Pose;
  /** Turns a handle by an angle in radians, counter-clockwise with y upwards; in space about an axis. */
  turn(handle: number, angle: number, axis?: Points | null): Pose;
}
/** A regular grid over a domain. */
export interface Grid extends Handle {
  readonly info: GridInfo;
  readonly dim: number;
  /** A grid of half the spacing. */
  refine(): Grid;
  /** The grid without the vertices whose byte is 0. */
  restrict(keep: Uint8Array): Grid;
  /** One byte per vertex, 1 inside. */
  inside(): Uint8Array;
  /** The grassfire's maximum. The fire burnt this many rounds before it reached the vertex. */
  findMaximum(): { vertex: number; rounds: number };
  /** Positions of vertices, flat; of all without an argument. */
  points(vertices?: ArrayLike<number> | null): Float64Array;
  /** The vertex inside that is nearest to a point. */
  findNearest(point: Points): number;
}
/** A cousin tree over a grid. */
export interface Tree extends Handle {
  readonly grid: Grid;
  readonly root: number;
  /** The parent of each vertex; 4294967295 for those without. */
  parents(): Uint32Array;
  generations(): Int32Array;
  report(): TreeReport;
  /** Orders the vertices so that the root is the only critical one. */
  grow(values?: Float64Array | null): { rank: Uint32Array; report: GrowReport };
  /** Counts the critical vertices of an order: one number for each vertex. */
  rankReport(rank: Uint32Array): FunctionReport;
}
/** A function over a grid, with one maximum at the root of its tree. */
export interface GridFunction extends Handle {
  readonly info: FunctionInfo;
  /** How the function was computed. */
  readonly solverReport: SolverReport;
  readonly tree: Tree;
  values(): Float64Array;
  /** Natural logarithms of the values, or null. */
  logs(): Float64Array | null;
  /** Its critical vertices. */
  report(): FunctionReport;
  /** Compression (1) and expansion (2) edges in the plane. */
  edges(): { edges: Uint32Array; kinds: Int32Array; tested: number };
  /** Compression (1) and expansion (2) facets in any dimension, with dim vertices each. */
  facets(): { facets: Uint32Array; kinds: Int32Array; report: FacetReport };
  /** Only counts these facets. */
  facetReport(): FacetReport;
}
export type CurveEnd = 'none' | 'maximum' | 'boundary' | 'critical' | 'values';
/** Integral curves of a function through points. */
export interface Curves extends Handle {
  readonly info: CurvesInfo;
  /** Flat coordinates of each curve, which begins with its point. */
  vertices(): Float64Array[];
  /** How they end, with an entry for each curve. */
  ends(): { end: CurveEnd[]; length: Float64Array; alone: Float64Array; facet: Uint32Array; bary: Float64Array };
}

/** Progress, diagnostics and cancelling of calls. */
export interface Env {
  /** Receives the stage and the share of the call that is done. Return true to cancel. */
  progress?: ((stage: string, share: number) => boolean | void) | null;
  log?: ((line: string) => void) | null;
  signal?: AbortSignal | null;
}

export interface Instance {
  readonly module: WebAssembly.Module;
  readonly IccError: typeof IccError;
  readonly Domain: DomainClass;
  readonly Chart: ChartClass;
  readonly Map: MapClass;
  readonly Match: MatchClass;
  readonly Coverage: CoverageClass;
  readonly Fit: FitClass;
  readonly Shape: new (regions: readonly Domain[], curves?: { vertices?: Points; segments?: Indices; dim?: number }) => Shape;
  readonly Sampling: {
    new (shape: Shape, options?: SamplingOptions | null): Sampling;
    fromPoints(shape: Shape, points: Points): Sampling;
    load(bytes: Uint8Array): Sampling;
  };
  readonly Weights: new (sampling: Sampling, handles: Points, options?: WeightsOptions | null) => Weights;
  readonly Binding: {
    new (weights: Weights, points: Points, options?: { derivatives?: boolean }): Binding;
    load(bytes: Uint8Array): Binding;
  };
  readonly Pose: new (handles: Points, dim?: number) => Pose;
  readonly Grid: { new (domain: Domain, cells?: number): Grid; mask(shape: readonly number[], inside: Uint8Array): Grid };
  readonly Tree: {
    new (grid: Grid, root: number, options?: TreeOptions | null): Tree;
    fromParents(grid: Grid, root: number, parents: ArrayLike<number>, options?: TreeOptions | null): Tree;
  };
  readonly GridFunction: {
    new (tree: Tree, options?: FunctionOptions | null): GridFunction;
    fromValues(tree: Tree, values: ArrayLike<number>): GridFunction;
    fromLogs(tree: Tree, logs: ArrayLike<number>): GridFunction;
    /** Solves an equation with fixed values, NaN where a vertex is free, and a right-hand side. */
    solve(
      tree: Tree,
      options?: FunctionOptions | null,
      fixed?: ArrayLike<number> | null,
      rightSide?: ArrayLike<number> | null,
    ): GridFunction;
    ofChart(chart: Chart): GridFunction | null;
  };
  readonly Curves: new (gridFunction: GridFunction, points: Points, way?: 'up' | 'down') => Curves;
  /** Proves that a sampled field does not fold, or lists up to `most` cells where it does (1000). */
  certifyField(field: SampledField, most?: number):
    FieldReport & { cells: Uint32Array; kinds: ('folded' | 'undecided' | 'missing')[] };
  /** All defects that keep a closed polygon from being a boundary. */
  boundaryDefects(outline: Points): { kind: string; a: number; b: number }[];
  /** Repairs a mask in which cells touch only at an edge or a corner. Gives the number of filled cells. */
  repairMask(shape: readonly number[], cells: Uint8Array): number;
  /** A constrained Delaunay triangulation of a simple polygon, the first points, and points inside it. */
  triangulate(nBoundary: number, points: Points): Uint32Array;
  /** Calls a function of C without its arguments out, env and err. It does not compare lengths of arrays with counts. */
  call(name: string, ...args: unknown[]): any;
  /** Watches the calls in `work`, and can cancel them. */
  during<T>(env: Env, work: () => T): T;
  readonly memoryBytes: number;
  readonly version: string;
  readonly versionNumber: number;
  /** 'ICC_ERR_OUTSIDE' for 7. */
  statusName(status: number): string;
  /** 'OUTSIDE' for 7. */
  codeOf(status: number): string;
}

/** Makes an instance of the library, with its own memory. */
export function load(source?: Source | Promise<Source>): Promise<Instance>;

/** The same interface in a worker: promises of values, and objects by reference. */
type Object_ = Handle | Pose;
export type Far<T> = T extends Object_ ? Away<T> : T extends null ? null
  : T extends { weights: Weights; energy: infer E } ? { weights: Away<Weights>; energy: E }
  : T extends { map: Map; report: infer R } ? { map: Away<Map>; report: R } : T;
type Given<A> = { [K in keyof A]: A[K] extends Object_ ? Away<A[K]> : A[K] | Near<A[K]> };
type Near<T> = T extends readonly Domain[] ? readonly Away<Domain>[] : T extends ShapeLike ? T | Away<Domain> : T;
export type Away<T> = { free(): void; [Symbol.dispose](): void } & {
  readonly [K in Exclude<keyof T, 'free' | 'warp' | typeof Symbol.dispose>]: T[K] extends (...args: infer A) => infer R
    ? (...args: Given<A>) => Promise<Far<R>> : Promise<Far<T[K]>>;
} & (T extends Map ? {
  /** As Map.warp(), but of copies: `target` stays as it is, and the promise gives the painted picture. */
  warp<P extends Picture>(source: Picture, target: P): Promise<P>;
} : {});
type Statics<C> = { [K in keyof C]: C[K] extends (...args: infer A) => infer R ? (...args: Given<A>) => Promise<Far<R>> : never };
export type AwayClass<C> = Statics<C> & (C extends new (...args: infer A) => infer T
  ? { create(...args: Given<A>): Promise<Far<T>> } : {});
type Class = 'Domain' | 'Chart' | 'Map' | 'Match' | 'Coverage' | 'Fit'
  | 'Shape' | 'Sampling' | 'Weights' | 'Binding' | 'Pose' | 'Grid' | 'Tree' | 'GridFunction' | 'Curves';
type AwayFunctions = { [K in 'boundaryDefects' | 'triangulate' | 'statusName' | 'codeOf']:
  Instance[K] extends (...args: infer A) => infer R ? (...args: A) => Promise<R> : never };

/** A Worker of a browser, or of node's worker_threads. */
export interface WorkerLike { postMessage(message: any, transfer?: any): void; terminate(): unknown }

/** Calls of the operations that serve() answers in a worker, one at a time. */
export class Remote {
  static start(worker: WorkerLike | MakeOperations, source?: Source | Promise<Source>): Promise<Remote>;
  /** True if a running call can be stopped. */
  readonly stops: boolean;
  call(name: string, argument?: unknown, env?: Env & { lost?: (result: any) => void }): Promise<any>;
  latest<T>(channel: string, work: () => Promise<T>): Promise<T | undefined>;
  close(): void;
}
export type MakeOperations = (icc: Instance) => Record<string, (argument: any) => unknown>;
export function serve(make: MakeOperations): Promise<void>;

/** The classes of an instance in a worker. */
export type AsyncIcc = { readonly [K in Class]: AwayClass<Instance[K]> } & AwayFunctions & {
  readonly stops: boolean;
  /** Watches the calls that `work` begins before it waits for any, and can cancel them. */
  during<T>(env: Env, work: () => T): T;
  /** While one work of a channel runs, only the last of those that come is kept. The others give undefined. */
  latest<T>(channel: string, work: () => Promise<T>): Promise<T | undefined>;
  close(): void;
};
export const AsyncIcc: {
  start(options?: { source?: Source | Promise<Source>; worker?: WorkerLike }): Promise<AsyncIcc>;
};
export const constants: Readonly<Record<string, number>>;
