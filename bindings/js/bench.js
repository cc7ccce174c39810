// Times of the package, of CPU: what a call costs by itself, and small ones; frames of a cage whose corner is dragged.
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

/** A ring of n corners, with a wavy rim. */
const ring = (n) => Array.from({ length: n }, (_, k) => {
  const a = (2 * Math.PI * k) / n, r = 200 + 40 * Math.cos(5 * a);
  return [256 + r * Math.cos(a), 256 + r * Math.sin(a)];
});

/** A drag of FRAMES frames there and back, by 5 pixels each, as a page does it on its main thread: a target, a map that
 *  follows, its mesh. The sorted times of the frames, and how many were not certified. */
function drag(n) {
  const FRAMES = 200, STEPS = 2, source = ring(n), times = [];
  let now = new icc.Map(source, source), uncertified = 0;
  for (let frame = 0; frame < FRAMES; ++frame) {
    const share = 1 - Math.abs(1 - (2 * (frame % 40)) / 40), corner = Math.floor(frame / 40) * Math.floor(n / 5);
    const target = source.map((p, k) => (k === corner ? p.map((v) => v + (256 - v) * 0.5 * share) : p));
    const start = process.cpuUsage();
    const next = now.retarget(target, STEPS);
    next.mesh();
    const { user, system } = process.cpuUsage(start);
    times.push((user + system) / 1e3);
    uncertified += next.certified ? 0 : 1;
    now.free();
    now = next;
  }
  return { times: times.sort((a, b) => a - b), uncertified };
}

console.log();
for (const n of [12, 50, 100, 200]) {
  drag(n); // compiled
  const { times, uncertified } = drag(n), at = (share) => times[Math.floor(share * (times.length - 1))].toFixed(1);
  console.log(`frame of a cage of ${String(n).padStart(3)} corners: median ${at(0.5)} ms, 95 % below ${at(0.95)} ms, `
    + `most ${at(1)} ms; ${uncertified} of ${times.length} not certified`);
}
