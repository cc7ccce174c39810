/// <reference lib="esnext.disposable" />
/** A point by the names of its coordinates. */
export interface Point { readonly x: number; readonly y: number; readonly z?: number }
/** Rows of coordinates: flat, one array a point, or one object a point. */
export type Points = Float64Array | readonly number[] | readonly (readonly number[])[] | readonly Point[] | Point;
export type Indices = Uint32Array | readonly number[] | readonly (readonly number[])[];
/** The members of a struct of C, in camel case. */
export type Info = Record<string, any>;
export type Options = Record<string, any>;
/** Pixels as ImageData has them. */
export interface Picture { width: number; height: number; data: Uint8ClampedArray | Uint8Array }
export interface Results { out?: Float64Array; status?: Int32Array }
export type Source = BufferSource | WebAssembly.Module | Response;

export class IccError extends Error {
  readonly code: string;
  readonly index: number;
  readonly item: string;
  readonly side: 'source' | 'target' | null;
}

export interface Handle { free(): void; [Symbol.dispose](): void }
export interface Features {
  holes?: readonly Points[]; lines?: readonly Points[]; points?: readonly Points[]; radii?: readonly number[];
}

export interface Domain extends Handle {
  readonly info: Info;
  readonly dim: number;
  fill(options?: Options): Domain;
  boundary(): { vertices: Float64Array; facets: Uint32Array };
  mesh(): { vertices: Float64Array; simplices: Uint32Array };
  features(): Info[];
  locate(points: Points): { where: Int32Array; facet: Uint32Array; bary: Float64Array };
}
export interface DomainClass {
  polygon(outline: Points, features?: Features): Domain;
  surface(vertices: Points, facets: Indices, dim?: number): Domain;
  mesh(vertices: Points, simplices: Indices, options?: { dim?: number; facets?: Indices | null }): Domain;
  mask(shape: readonly number[], cells: Uint8Array): Domain;
}
export type ShapeLike = Domain | Points;

export interface Coordinates { facet: Uint32Array; bary: Float64Array; t: Float64Array }
export interface Chart extends Handle {
  readonly info: Info;
  readonly dim: number;
  readonly details: Info;
  readonly certified: boolean;
  readonly domain: Domain;
  report(nPoints?: number): Info;
  encode(points: Points): Coordinates & { status: Int32Array };
  decode(coordinates: Coordinates): { points: Float64Array; status: Int32Array };
  trace(point: Points): Float64Array;
  save(): Uint8Array;
}
export interface Match extends Handle {
  readonly info: Info;
  readonly source: Domain;
  readonly target: Domain;
  origins(): { source: Int32Array; target: Int32Array };
  apply(points: Points, options?: { out?: Float64Array; off?: Float64Array | null }): Float64Array;
  inverse(points: Points, options?: { out?: Float64Array; off?: Float64Array | null }): Float64Array;
  save(): Uint8Array;
}
export interface MatchClass {
  new (source: ShapeLike, target: ShapeLike, landmarks?: Points, options?: Options | null): Match;
  load(bytes: Uint8Array): Match;
}
export interface ChartClass { new (domain: ShapeLike, options?: Options | null): Chart; load(bytes: Uint8Array): Chart }

export interface Tie { vertex: number[]; source: Float64Array; target: Float64Array; length: number[] }
export interface Map extends Handle {
  readonly info: Info;
  readonly dim: number;
  readonly report: Info;
  readonly certified: boolean;
  readonly sourceChart: Chart | null;
  readonly targetChart: Chart | null;
  improve(options?: Options | null): Map;
  retarget(target: ShapeLike, iterations?: number): Map;
  mesh(): { vertices: Float64Array; images: Float64Array; simplices: Uint32Array };
  toProj(systems?: { sourceCrs?: string; targetCrs?: string }): string;
  apply(points: Points, results?: Results): Float64Array;
  inverse(images: Points, results?: Results): Float64Array;
  jacobian(points: Points, results?: Results): Float64Array;
  certify(vertices: Points, simplices: Indices): { images: Float64Array; certificate: Info };
  repair(vertices: Points, simplices: Indices): { images: Float64Array; certificate: Info };
  ties(): Tie[];
  warp<P extends Picture>(source: Picture, target: P): P;
  save(): Uint8Array;
}
export interface MapClass {
  new (source: ShapeLike, target: ShapeLike, options?: Options | null): Map;
  fromCharts(source: Chart, target: Chart, options?: Options | null): Map;
  load(bytes: Uint8Array): Map;
}

export interface Shape extends Handle { readonly dim: number }
export interface Sampling extends Handle { readonly info: Info; readonly dim: number; points(): Float64Array; save(): Uint8Array }
export interface Weights extends Handle {
  readonly info: Info;
  readonly dim: number;
  nodes(): { points: Float64Array; initial: Float64Array; values: Float64Array; status: Int32Array };
  evaluate(points: Points, results?: { out?: Float64Array; gradients?: Float64Array }): Float64Array;
  dual(node: number, points: Points, results?: { out?: Float64Array }): Float64Array;
  report(points: Points): Info;
  paint(handle: number, centre: Points, radius: number, amount: number): Weights;
  repaint(nodes: Uint32Array, values: Points): Weights;
  withMethod(method: string): Weights;
  stiffen(nodes: Uint32Array, rigidity?: Float64Array | null): { weights: Weights; energy: Float64Array };
  bind(points: Points, options?: { derivatives?: boolean }): Binding;
}
export interface Binding extends Handle {
  readonly info: { nPoints: number; nHandles: number; dim: number };
  readonly dim: number;
  weights(): { handles: Float64Array; weights: Float64Array };
  pose(pose: Pose, results?: { out?: Float64Array; jacobians?: Float64Array }): Float64Array;
  save(): Uint8Array;
}
export interface Pose {
  readonly dim: number;
  readonly handles: Float64Array;
  readonly transforms: Float64Array;
  reset(): Pose;
  move(handle: number, offset: Points): Pose;
  turn(handle: number, angle: number, axis?: Points | null): Pose;
}
export interface Grid extends Handle {
  readonly info: Info;
  refine(): Grid;
  restrict(keep: Uint8Array): Grid;
  inside(): Uint8Array;
  findMaximum(): { vertex: number; rounds: number };
  points(vertices?: ArrayLike<number> | null): Float64Array;
  findNearest(point: Points): number;
}
export interface Tree extends Handle {
  readonly grid: Grid;
  readonly root: number;
  parents(): Uint32Array;
  generations(): Int32Array;
  report(): Info;
  grow(values?: Float64Array | null): { rank: Uint32Array; report: Info };
  rankReport(rank: Uint32Array): Info;
}
export interface GridFunction extends Handle {
  readonly info: Info;
  readonly solverReport: Info;
  readonly tree: Tree;
  values(): Float64Array;
  logs(): Float64Array | null;
  report(): Info;
  edges(): { edges: Uint32Array; kinds: Int32Array; tested: number };
  facets(): { facets: Uint32Array; kinds: Int32Array; report: Info };
  facetReport(): Info;
}
export type CurveEnd = 'none' | 'maximum' | 'boundary' | 'critical' | 'values';
export interface Curves extends Handle {
  readonly info: Info;
  vertices(): Float64Array[];
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
  readonly Domain: DomainClass;
  readonly Chart: ChartClass;
  readonly Map: MapClass;
  readonly Match: MatchClass;
  readonly Shape: new (regions: readonly Domain[], curves?: { vertices?: Points; segments?: Indices; dim?: number }) => Shape;
  readonly Sampling: {
    new (shape: Shape, options?: Options | null): Sampling;
    fromPoints(shape: Shape, points: Points): Sampling;
    load(bytes: Uint8Array): Sampling;
  };
  readonly Weights: new (sampling: Sampling, handles: Points, options?: Options | null) => Weights;
  readonly Binding: {
    new (weights: Weights, points: Points, options?: { derivatives?: boolean }): Binding;
    load(bytes: Uint8Array): Binding;
  };
  readonly Pose: new (handles: Points, dim?: number) => Pose;
  readonly Grid: { new (domain: Domain, cells?: number): Grid; mask(shape: readonly number[], inside: Uint8Array): Grid };
  readonly Tree: {
    new (grid: Grid, root: number, options?: Options | null): Tree;
    fromParents(grid: Grid, root: number, parents: ArrayLike<number>, options?: Options | null): Tree;
  };
  readonly GridFunction: {
    new (tree: Tree, options?: Options | null): GridFunction;
    fromValues(tree: Tree, values: ArrayLike<number>): GridFunction;
    fromLogs(tree: Tree, logs: ArrayLike<number>): GridFunction;
    ofChart(chart: Chart): GridFunction | null;
  };
  readonly Curves: new (gridFunction: GridFunction, points: Points, way?: 'up' | 'down') => Curves;
  boundaryDefects(outline: Points): { kind: string; a: number; b: number }[];
  repairMask(shape: readonly number[], cells: Uint8Array): number;
  triangulate(nBoundary: number, points: Points): Uint32Array;
  call(name: string, ...args: unknown[]): any;
  /** Watches the calls in `work`, and can cancel them. */
  during<T>(env: Env, work: () => T): T;
  readonly memoryBytes: number;
  readonly version: string;
  readonly versionNumber: number;
  statusName(status: number): string;
  codeOf(status: number): string;
}

/** Makes an instance of the library, with its own memory. */
export function load(source?: Source | Promise<Source>): Promise<Instance>;

/** The same interface in a worker: promises of values, and objects by reference. */
type Object_ = Handle | Pose;
export type Far<T> = T extends Object_ ? Away<T> : T extends null ? null
  : T extends { weights: Weights; energy: infer E } ? { weights: Away<Weights>; energy: E } : T;
type Given<A> = { [K in keyof A]: A[K] extends Object_ ? Away<A[K]> : A[K] | Near<A[K]> };
type Near<T> = T extends readonly Domain[] ? readonly Away<Domain>[] : T extends ShapeLike ? T | Away<Domain> : T;
export type Away<T> = { free(): void; [Symbol.dispose](): void } & {
  readonly [K in Exclude<keyof T, 'free' | typeof Symbol.dispose>]: T[K] extends (...args: infer A) => infer R
    ? (...args: Given<A>) => Promise<Far<R>> : Promise<Far<T[K]>>;
};
type Statics<C> = { [K in keyof C]: C[K] extends (...args: infer A) => infer R ? (...args: Given<A>) => Promise<Far<R>> : never };
export type AwayClass<C> = Statics<C> & (C extends new (...args: infer A) => infer T
  ? { create(...args: Given<A>): Promise<Far<T>> } : {});
type Class = 'Domain' | 'Chart' | 'Map' | 'Match' | 'Shape' | 'Sampling' | 'Weights' | 'Binding' | 'Pose' | 'Grid' | 'Tree' | 'GridFunction' | 'Curves';
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
