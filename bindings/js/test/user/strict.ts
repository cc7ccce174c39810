// What `tsc --strict` has to take of the package's types; compiled only.
import { AsyncIcc, IccError, Remote, load, serve } from 'libicc';
import type { Instance, Map as IccMap, MapOptions, WeightsInfo } from 'libicc';
import { drawWarped, pixelsOf } from 'libicc/canvas';
import { type Geometry, bend, surfaceOf } from 'libicc/three';

const square: [number, number][] = [[0, 0], [4, 0], [4, 4], [0, 4]];

export async function near(): Promise<number> {
  const icc: Instance = await load();
  using map = new icc.Map(square, square, { kind: 'mesh' });
  const out: Float64Array = map.apply([[1, 1]], { out: new Float64Array(2) });
  using other = icc.during({ progress: (stage, share) => stage === 'improve' && share > 0.5 }, () => map.improve());
  try {
    icc.Domain.polygon([0, 0, 1, 1]);
  } catch (error) {
    if (error instanceof IccError) return error.index + error.message.length;
  }
  // @ts-expect-error: a map is not made of a number
  new icc.Map(5, square);
  const options: MapOptions = { kind: 'mesh', iterations: 5, chart: { method: 'disc', maximum: null }, ties: map.ties() };
  new icc.Map(square, square, options);
  // @ts-expect-error: no such member
  new icc.Map(square, square, { knd: 'mesh' });
  // @ts-expect-error: no such word
  new icc.Map(square, square, { kind: 'mehs' });
  // @ts-expect-error: no such member of the chart's options
  new icc.Map(square, square, { chart: { methd: 'disc' } });
  // @ts-expect-error: no such member
  map.info.energie;
  const energy: number = map.info.energy, kind: 'mesh' | 'curves' | 'none' = map.info.kind, made: number = map.report.nInverted;
  using fit = new icc.Fit(square, square, null, { model: 'spline', tolerance: [1, 1, 1, 1], lines: [[square, square]] });
  const changed: number = icc.Map.nearest(square, [0, 1, 2], square).report.changed + fit.info.leftOut + fit.map.dim;
  // @ts-expect-error: no such member
  new icc.Fit(square, square, null, { modle: 'spline' });
  using coverage = new icc.Coverage({ a: square }, new Map([['a', square]]), { weld: [0, 0], unmatched: 'leave_out' });
  // @ts-expect-error: no such word
  new icc.Coverage({ a: square }, { a: square }, { unmatched: 'leave out' });
  const names: (string | number)[] = [...coverage.regions, ...coverage.differences.flatMap(({ regions }) => regions)];
  const weights = new icc.Weights(new icc.Sampling(new icc.Shape([icc.Domain.polygon(square)]), { spacing: 1, fixed: square }),
    square, { method: 'qp', edges: [[0, 1]], lines: [{ from: [0, 0], to: [4, 0] }] });
  const info: WeightsInfo = weights.withMethod('equality').info;
  const seconds: object = [weights.timings, new icc.Chart(square).timings];
  const feature = { type: 'Feature', properties: { id: 1 }, geometry: { type: 'Polygon', coordinates: [[[0, 0], [1, 0], [0, 1], [0, 0]]] } };
  const shown: number = new icc.Map(feature, feature.geometry).geojson(feature, { segment: 1 }).properties.id;
  const given: ImageData = map.warp(new ImageData(4, 4), new ImageData(8, 8));
  if (seconds instanceof icc.IccError) return energy + changed + made + names.length + coverage.info.nNodes + info.nHandles + shown + given.width + kind.length;
  return out[0]! + other.dim;
}

export async function far(signal: AbortSignal): Promise<Float64Array | undefined> {
  const icc = await AsyncIcc.start();
  const domain = await icc.Domain.polygon(square, { points: [[1, 1]] });
  using map = await icc.during({ signal, progress: (stage, share) => console.log(stage, share) },
    () => icc.Map.create(domain, square));
  const moved = await icc.latest('drag', () => map.retarget(square));
  const certified: boolean = await map.certified;
  const chart = await map.sourceChart;
  const t: Float64Array | undefined = (await chart?.encode([[1, 1]]))?.t;
  const { images } = await map.mesh();
  const painted: ImageData = await map.warp(new ImageData(4, 4), new ImageData(8, 8));
  const near = await icc.Map.nearest(square, [0, 1, 2], square), fit = await icc.Fit.create(square, square, domain);
  const energy: number = (await map.info).energy + painted.width + (await (await fit.map).info).energy + near.report.moved;
  // @ts-expect-error: no such member
  await icc.Map.create(domain, square, { knd: energy });
  const shape = await icc.Shape.create([domain]);
  shape.free();
  icc.close();
  return certified ? await moved?.apply(images) : t;
}

export function page(map: IccMap, canvas: HTMLCanvasElement, image: HTMLImageElement, geometry: Geometry): number {
  drawWarped(canvas, map, image);
  return bend(geometry, map) + surfaceOf(geometry).facets.length + pixelsOf(image).width;
}

export async function own(worker: Worker): Promise<void> {
  void serve((icc) => ({ version: () => icc.version }));
  const remote = await Remote.start(worker);
  await remote.call('version', null, { signal: AbortSignal.timeout(1000) });
}
