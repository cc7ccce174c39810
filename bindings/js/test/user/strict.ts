// What `tsc --strict` has to take of the package's types; compiled only.
import { AsyncIcc, IccError, Remote, load, serve } from 'libicc';
import type { Instance } from 'libicc';

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
  const shape = await icc.Shape.create([domain]);
  shape.free();
  icc.close();
  return certified ? await moved?.apply(images) : t;
}

export async function own(worker: Worker): Promise<void> {
  void serve((icc) => ({ version: () => icc.version }));
  const remote = await Remote.start(worker);
  await remote.call('version', null, { signal: AbortSignal.timeout(1000) });
}
