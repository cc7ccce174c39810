// Times of the package, of CPU: what a call costs by itself, and small ones; frames of a cage whose corner is
// dragged; pictures, poses, and what is made once.
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
/** The least time of a call, in microseconds, of REPEATS times that many calls. */
function leastOf(calls, work) {
  let least = Infinity;
  for (let repeat = 0; repeat < REPEATS; ++repeat) {
    const start = process.cpuUsage();
    for (let k = 0; k < calls; ++k) work();
    const { user, system } = process.cpuUsage(start);
    least = Math.min(least, (user + system) / calls);
  }
  return least;
}
for (const [name, work] of Object.entries(cases)) console.log(`${name.padEnd(40)} ${leastOf(CALLS, work).toFixed(2)} us`);

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

// What a page waits for besides: a picture, a pose of bound points, and what is made once.
const round = ring(50), bent = round.map(([x, y], i) => [x + (i < 10 ? 20 : 0), y]), pixels = new Uint8ClampedArray(4 * 512 * 512);
const picture = { width: 512, height: 512, data: pixels }, painted = { ...picture, data: new Uint8ClampedArray(pixels.length) };
const still = new icc.Map(round, bent), places = Float64Array.from({ length: 20000 }, (_, k) => 150 + (k * 7919) % 200);
const handles = [[200, 256], [256, 200], [300, 256], [256, 300]], shape = new icc.Shape([icc.Domain.polygon(round)]);
const sampling = new icc.Sampling(shape, { spacing: 15, fixed: handles }), weights = new icc.Weights(sampling, handles);
const binding = weights.bind(places), turned = new icc.Pose(handles).turn(0, 0.3), posed = new Float64Array(places.length);
const once = {
  'Map.warp() of 512 x 512 pixels': [5, () => still.warp(picture, painted)],
  'Map.apply() of 10,000 points': [20, () => still.apply(places, { out: posed })],
  'Binding.pose() of 10,000 points': [50, () => binding.pose(turned, { out: posed })],
  'new Map() of 50 corners': [3, () => new icc.Map(round, bent).free()],
  'new Weights() of 4 handles': [3, () => new icc.Weights(sampling, handles).free()],
  'Weights.bind() of 10,000 points': [3, () => weights.bind(places).free()],
  "new Chart() by 'gradient'": [3, () => new icc.Chart(round, { method: 'gradient', cells: 100 }).free()],
};
console.log();
for (const [name, [calls, work]] of Object.entries(once))
  console.log(`${name.padEnd(40)} ${(leastOf(calls, work) / 1e3).toFixed(2)} ms`);
