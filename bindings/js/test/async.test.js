// Watching and stopping calls, and the classes over a worker. usage: ICC_PACKAGE=FOLDER node --test test
import assert from 'node:assert/strict';
import test from 'node:test';
import { pathToFileURL } from 'node:url';

const at = (file) => import(pathToFileURL(`${process.env.ICC_PACKAGE}/src/${file}`));
const { load, AsyncIcc, IccError, Remote } = await at('index.js');
const { classesOf } = await at('instance.js');
const icc = await load();

const SQUARE = [[0, 0], [4, 0], [4, 4], [0, 4]];
const LEANING = [[0, 0], [4, 1], [5, 5], [-1, 4]];
const CROSSED = [[0, 0], [4, 4], [4, 0], [0, 4]];
const isCode = (code) => (e) => e instanceof IccError && e.code === code;
const isAborted = (e) => e.name === 'AbortError';

/** A chart that takes ten seconds and more. */
const SLOW = [SQUARE, { method: 'gradient', function: 'bilaplace', cells: 1200 }];

test('a call tells how far it is, and can be cancelled', () => {
  const shares = [], stages = new Set(), [source, target] = [SQUARE, LEANING].map((outline) => icc.Domain.polygon(outline));
  const make = () => new icc.Map(source, target);
  icc.during({ progress: (stage, share) => { stages.add(stage); shares.push(share); } }, make);
  assert.ok(stages.has('mesh') && stages.has('improve'), [...stages].join());
  assert.deepEqual(shares, [...shares].sort((a, b) => a - b));
  assert.equal(shares.at(-1), 1);
  assert.throws(() => icc.during({ progress: (_, share) => share > 0.3 }, make), isCode('CANCELLED'));
  assert.throws(() => icc.during({ progress: () => { throw new RangeError('mine'); } }, make), /^RangeError: mine$/);
  const controller = new AbortController();
  assert.throws(() => icc.during({ signal: controller.signal, progress: () => controller.abort() }, make), isAborted);
  assert.throws(() => icc.during({ signal: controller.signal }, () => assert.fail('it was run')), isAborted);
  const count = shares.length;
  make();
  assert.equal(shares.length, count);
});

test('a callback may use the library', () => {
  let areas = 0;
  const map = icc.during({ progress: () => { areas += icc.Domain.polygon(SQUARE).info.nVertices; } },
    () => new icc.Map(SQUARE, LEANING));
  assert.ok(areas > 0 && areas % 4 === 0);
  assert.equal(map.certified, true);
});

test('cancelled calls leave the memory as it was', () => {
  const once = (k) => assert.throws(() => icc.during({ progress: (_, share) => share >= k / 100 },
    () => new icc.Map(SQUARE, LEANING)), isCode('CANCELLED'));
  for (let k = 0; k < 100; ++k) once(k);
  const before = icc.memoryBytes;
  for (let k = 0; k < 1000; ++k) once(k % 100);
  assert.equal(icc.memoryBytes, before);
});

test('objects of a wrong class or of another instance are refused by name', async () => {
  const map = new icc.Map(SQUARE, LEANING), domain = icc.Domain.polygon(SQUARE), other = await load();
  assert.throws(() => icc.call('icc_map_get_info', domain, {}), /icc_map_get_info: map is a Domain, but has to be of icc_map/);
  assert.throws(() => icc.call('icc_map_get_info', 1024, {}), /map is 1024, but/);
  assert.throws(() => other.call('icc_map_get_info', map, {}), /map is a Map of another instance/);
  assert.throws(() => new other.Map(domain, SQUARE), /source is a Domain of another instance/);
  assert.throws(() => new icc.Shape([domain, map]), /regions is a Map, but/);
  assert.throws(() => new other.Shape([domain]), /regions is a Domain of another instance/);
});

test('a number is no handle, and no pointer', () => {
  const handles = [[1, 1], [3, 1]];
  assert.throws(() => new icc.Map(5, SQUARE), /source is 5, but has to be a Domain or an outline/);
  assert.throws(() => new icc.Map(SQUARE, 5), /target is 5, but/);
  assert.throws(() => new icc.Match(5, SQUARE), /source is 5, but/);
  assert.throws(() => new icc.Chart(5), /domain is 5, but/);
  assert.throws(() => new icc.Domain(5), /made by Domain.polygon/);
  assert.throws(() => new icc.Shape([5]), /regions is 5, but has to be of icc_domain/);
  assert.throws(() => new icc.Sampling(5), /shape is 5, but has to be of icc_shape/);
  assert.throws(() => new icc.Weights(5, handles), /sampling is 5, but has to be of icc_sampling/);
  assert.throws(() => new icc.Binding(5, handles), /weights is 5, but has to be of icc_weights/);
  assert.throws(() => new icc.Grid(5), /domain is 5, but has to be of icc_domain/);
  assert.throws(() => new icc.Tree(5, 0), /grid is 5, but has to be of icc_grid/);
  assert.throws(() => new icc.GridFunction(5), /tree is 5, but has to be of icc_tree/);
  assert.throws(() => new icc.Map(SQUARE, LEANING).retarget(5), /target is 5, but/);
  assert.throws(() => icc.call('icc_map_apply', new icc.Map(SQUARE, LEANING), 1, 1024, null, null, null), /1024 is no array/);
  const shape = new icc.Shape([icc.Domain.polygon(SQUARE)]);
  assert.throws(() => icc.call('icc_sampling_create', shape, { spacing: 1, nFixed: 1, fixed: 1024 }), /1024 is no array/);
});

test('over a worker: the same classes, the same numbers, the same errors', async () => {
  const far = await AsyncIcc.start(), map = await far.Map.create(SQUARE, LEANING), here = new icc.Map(SQUARE, LEANING);
  const points = [[1, 1], [2, 3]];
  assert.deepEqual(await map.apply(points), here.apply(points));
  assert.deepEqual(await map.mesh(), here.mesh());
  assert.equal((await map.info).energy, here.info.energy);
  const chart = await map.sourceChart;
  assert.equal((await chart.info).method, 'disc');
  assert.deepEqual(await (await far.Map.load(here.save())).apply(points), here.apply(points));
  const domain = await far.Domain.polygon(SQUARE, { points: [[1, 1]] });
  assert.equal(await (await domain.features()).length, 1);
  assert.equal(await (await far.Map.create(domain, domain)).certified, true);
  await assert.rejects(far.Map.create(SQUARE, CROSSED), (e) => isCode('BOUNDARY')(e) && e.index === 0 && e.item === 'facet');
  await assert.rejects(far.Map.create(SQUARE, LEANING, { knid: 'mesh' }), /no member knid/);
  assert.deepEqual(await far.boundaryDefects(CROSSED), [{ kind: 'crossing', a: 0, b: 2 }]);
  const handles = [[1, 1], [3, 1], [2, 3]], shape = await far.Shape.create([await far.Domain.polygon(SQUARE)]);
  const weights = await far.Weights.create(await far.Sampling.create(shape, { spacing: 0.5, fixed: handles }), handles);
  const pose = await far.Pose.create(handles), binding = await weights.bind([[2, 2]]);
  assert.equal(await pose.move(0, [1, 0]), pose);
  assert.equal((await binding.pose(pose)).length, 2);
  assert.deepEqual(await pose.transforms, new icc.Pose(handles).move(0, [1, 0]).transforms);
  map.free();
  await assert.rejects(map.info, /this Map has been freed/);
  await assert.rejects(domain.locate(await far.Pose.create(handles)), /points are/);
  const second = await AsyncIcc.start();
  await assert.rejects(second.Map.create(domain, SQUARE), /another instance/);
  for (const name of Object.keys(classesOf(null))) assert.equal(typeof far[name].create, 'function');
  second.close();
  far.close();
  await assert.rejects(domain.info, /has been closed/);
});

test('only the latest target counts', async () => {
  const far = await AsyncIcc.start(), map = await far.Map.create(SQUARE, LEANING);
  let begun = 0;
  const targets = Array.from({ length: 20 }, (_, k) => [[0, 0], [4, 1 - k / 40], [5, 5], [-1, 4]]);
  const results = await Promise.all(targets.map((target) => far.latest('drag', () => (++begun, map.retarget(target)))));
  assert.equal(begun, 2);
  assert.deepEqual(results.map((r) => r !== undefined), targets.map((_, k) => k === 0 || k === 19));
  const [there] = [await results[19].apply([[4, 0]])];
  assert.ok(Math.abs(there[1] - targets[19][1][1]) < 1e-12);
  await assert.rejects(far.latest('drag', async () => { throw new RangeError('mine'); }), /mine/);
  assert.equal(await far.latest('drag', () => map.dim), 2);
  far.close();
});

test('a call in a worker is watched, and stopped', async () => {
  const far = await AsyncIcc.start(), shares = [];
  assert.equal(far.stops, true);
  await far.during({ progress: (stage, share) => { shares.push(share); } }, () => far.Map.create(SQUARE, LEANING));
  assert.equal(shares.at(-1), 1);
  const controller = new AbortController(), { signal } = controller;
  const abort = { signal, progress: () => controller.abort() };
  const running = far.during(abort, () => far.Chart.create(...SLOW));
  const waiting = far.during({ signal }, () => far.Chart.create(...SLOW));
  const next = far.Map.create(SQUARE, LEANING);
  await Promise.all([running, waiting].map((promise) => assert.rejects(promise, isAborted)));
  const started = process.resourceUsage().userCPUTime;
  assert.equal(await (await next).certified, true);
  assert.ok(process.resourceUsage().userCPUTime - started < 1e6, 'the call was not stopped');
  far.close();
});

test('GeoJSON goes there and back, whatever its properties are called', async () => {
  const icc = await AsyncIcc.start(), ring = [[0, 0], [4, 0], [4, 4], [0, 4], [0, 0]];
  const feature = { type: 'Feature', properties: { object: 1, name: 'Map' }, geometry: { type: 'Polygon', coordinates: [ring] } };
  const map = await icc.Map.create(feature, feature), image = await map.geojson(feature);
  assert.deepEqual(image.properties, feature.properties);
  assert.equal(image.geometry.coordinates[0].length, 5);
  icc.close();
});

test('operations of one’s own, on this thread', async () => {
  const remote = await Remote.start((own) => ({ area: ({ outline }) => own.Domain.polygon(outline).info.nVertices }));
  assert.equal(await remote.call('area', { outline: SQUARE }), 4);
  await assert.rejects(remote.call('area', { outline: CROSSED }), isCode('BOUNDARY'));
  await assert.rejects(remote.call('none'), /not a function/);
  await assert.rejects(remote.call('area', { outline: () => {} }), /could not be cloned/);
  remote.close();
});
