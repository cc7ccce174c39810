// Times of the package, in microseconds of CPU: what a call costs by itself, and small ones.
// usage: node bindings/js/bench.js [PACKAGE]      (bindings/js/parity.sh time: beside the native library)
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const folder = path.resolve(process.argv[2] ?? 'build/wasm/package');
const { load } = await import(pathToFileURL(`${folder}/src/index.js`));
const icc = await load();
const square = [[0, 0], [4, 0], [4, 4], [0, 4]], map = new icc.Map(square, [[0, 0], [4, 1], [5, 5], [-1, 4]]);
const point = Float64Array.of(1, 1), out = new Float64Array(2), pose = new icc.Pose(square);
const REPEATS = 5, CALLS = 200000;

const cases = {
  'icc_version_number()': () => icc.call('icc_version_number'),
  'Pose.move()': () => pose.move(0, out),
  'Map.apply() of a point, into an array': () => map.apply(point, { out }),
  'Map.info': () => map.info,
};
for (const [name, work] of Object.entries(cases)) {
  let least = Infinity;
  for (let repeat = 0; repeat < REPEATS; ++repeat) {
    const start = process.cpuUsage();
    for (let k = 0; k < CALLS; ++k) work();
    const { user, system } = process.cpuUsage(start);
    least = Math.min(least, (user + system) / CALLS);
  }
  console.log(`${name.padEnd(40)} ${least.toFixed(2)} us`);
}
