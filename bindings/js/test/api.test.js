// The package as its users see it. usage: ICC_PACKAGE=FOLDER node --test test
import assert from 'node:assert/strict';
import fs from 'node:fs';
import test from 'node:test';
import { pathToFileURL } from 'node:url';

const at = (file) => import(pathToFileURL(`${process.env.ICC_PACKAGE}/src/${file}`));
const { load, IccError } = await at('index.js');
const { structs, functions, enumerations } = await at('layouts.js');
const icc = await load();

const SQUARE = [[0, 0], [4, 0], [4, 4], [0, 4]];
const LEANING = [[0, 0], [4, 1], [5, 5], [-1, 4]];
const CROSSED = [[0, 0], [4, 4], [4, 0], [0, 4]];
const near = (a, b, tolerance = 1e-12) => {
  assert.equal(a.length, b.length);
  for (let i = 0; i < a.length; ++i) assert.ok(Math.abs(a[i] - b[i]) <= tolerance, `${a[i]} is not ${b[i]}`);
};

test('the module imports a clock only', () => {
  const imports = WebAssembly.Module.imports(icc.module);
  assert.deepEqual(imports.map(({ module, name }) => `${module}.${name}`), ['icc.clock']);
});

test('every public function is exported, and nearly all are called by the classes', () => {
  const exported = new Set(WebAssembly.Module.exports(icc.module).map(({ name }) => name));
  const names = Object.keys(functions);
  assert.deepEqual(names.filter((name) => !exported.has(name)), []);
  const folder = `${process.env.ICC_PACKAGE}/src`;
  const code = fs.readdirSync(folder).filter((file) => file.endsWith('.js') && file !== 'layouts.js')
    .map((file) => fs.readFileSync(`${folder}/${file}`, 'utf8')).join('\n');
  const unused = names.filter((name) => !code.includes(`'${name}'`));
  assert.ok(unused.length <= 0.05 * names.length, unused.join(' '));
});

test('the types declare every class, with every method and member, and everything of an instance', () => {
  const types = fs.readFileSync(`${process.env.ICC_PACKAGE}/types/index.d.ts`, 'utf8');
  const bodyOf = (name) => new RegExp(`export interface ${name} [^]*?\\n\\}|export interface ${name} .*\\}$`, 'm').exec(types)?.[0] ?? '';
  const classes = Object.entries(icc).filter(([name, value]) => /^[A-Z]/.test(name) && name !== 'IccError' && typeof value === 'function');
  assert.ok(classes.length >= 13);
  for (const [name, Class] of classes)
    for (const key of Object.getOwnPropertyNames(Class.prototype).filter((k) => k !== 'constructor'))
      assert.match(bodyOf(name), new RegExp(`\\b${key}[:(<]`), `${name}.${key}`);
  for (const key of Object.keys(icc)) assert.match(bodyOf('Instance'), new RegExp(`\\b${key}[:(<]`), key);
});

test('members that hold words are members of the structs', () => {
  for (const [struct, member] of enumerations) assert.ok(structs[struct].members[member], `${struct}.${member}`);
});

test('points may be objects, and nothing else is taken for numbers', () => {
  const map = new icc.Map(SQUARE, LEANING);
  const images = map.apply([[1, 1], [2, 3]]);
  assert.deepEqual(map.apply([{ x: 1, y: 1 }, { x: 2, y: 3 }]), images);
  assert.deepEqual(map.apply([{ x: 1, y: 1 }, [2, 3]]), images);
  assert.deepEqual(map.apply({ x: 1, y: 1 }), images.subarray(0, 2));
  assert.deepEqual(map.apply(Float32Array.of(1, 1, 2, 3)), images);
  const polygon = icc.Domain.polygon(SQUARE.map(([x, y]) => ({ x, y })), { points: [{ x: 1, y: 1 }] });
  assert.equal(polygon.info.nFeatures, 1);
  for (const bad of [[['1', 2]], [[1, null]], ['1', '2'], [1, undefined], [{ x: '1', y: 1 }], [{ x: 1 }], 'ab', 7, [[1, [2]]], [true, false]])
    assert.throws(() => map.apply(bad), { name: 'TypeError', message: /point/ }, JSON.stringify(bad));
  for (const bad of [[1, 2, 3], [[1, 2, 3]], [{ x: 1, y: 1, z: 1 }], [[1, 2], [3]]])
    assert.throws(() => map.apply(bad), { name: 'TypeError', message: /numbers/ }, JSON.stringify(bad));
  assert.throws(() => new icc.Map(SQUARE, [['a', 0], [1, 0], [1, 1]]), { message: "target: points: 'a' is no number" });
  assert.throws(() => icc.call('icc_triangulate', 3, 3, [[0, 0], [1, '0'], [0, 1]], new Uint32Array(3)), TypeError);
});

test('outlines may be closed rings', () => {
  const closed = (ring) => [...ring, ring[0]];
  const open = new icc.Map(SQUARE, LEANING), map = new icc.Map(closed(SQUARE), closed(LEANING));
  assert.equal(map.info.nVertices, open.info.nVertices);
  assert.deepEqual(map.apply([[1, 1]]), open.apply([[1, 1]]));
  const hole = [[1, 1], [1, 2], [2, 2], [2, 1]];
  const domain = icc.Domain.polygon(Float64Array.from(closed(SQUARE).flat()), { holes: [closed(hole)] });
  assert.equal(domain.info.nVertices, 8);
  assert.equal(domain.info.measure, 15);
  assert.deepEqual(icc.boundaryDefects(closed(SQUARE)), []);
});

test('a fault of one of two shapes is that of a side', () => {
  for (const make of [(s, t) => new icc.Map(s, t), (s, t) => new icc.Match(s, t)]) {
    assert.throws(() => make(CROSSED, SQUARE), { side: 'source', code: 'BOUNDARY', message: /^source: edges/ });
    assert.throws(() => make(SQUARE, CROSSED), { side: 'target', code: 'BOUNDARY', message: /^target: edges/ });
  }
  assert.throws(() => new icc.Map(SQUARE, LEANING).retarget(CROSSED), { side: 'target', message: /^target: edges/ });
  assert.throws(() => icc.Domain.polygon(CROSSED), { side: null, message: /^edges/ });
});

test('a map takes points there and back, follows its target, and is saved', () => {
  const map = new icc.Map(SQUARE, LEANING);
  assert.equal(map.certified, true);
  assert.equal(map.info.kind, 'mesh');
  const points = Float64Array.of(1, 1, 2, 3, 3.5, 1.25);
  const images = map.apply(points), out = new Float64Array(6);
  assert.equal(map.inverse(images, { out }), out);
  near(out, points);
  assert.ok(Number.isNaN(map.apply([[9, 9]])[0]));
  const moved = map.retarget([[0, 0], [4, 0.5], [5, 5], [-1, 4]]);
  assert.equal(moved.certified, true);
  assert.equal(moved.sourceChart, null);
  assert.equal(map.sourceChart.info.method, 'disc');
  assert.deepEqual(icc.Map.load(map.save()).apply(points), images);
  const { vertices, simplices } = map.mesh();
  assert.equal(map.certify(vertices, simplices).certificate.nInverted, 0);
  const tin = JSON.parse(map.toProj({ sourceCrs: 'EPSG:2056' }));
  assert.equal(tin.file_type, 'triangulation_file');
  assert.equal(tin.input_crs, 'EPSG:2056');
  assert.deepEqual(tin.triangles.flat(), [...simplices]);
  assert.deepEqual(tin.vertices.map((row) => row.slice(0, 2)).flat(), [...vertices]);
  const [a, b, c, d] = map.jacobian([[1.01, 1.02]]);
  assert.ok(a * d - b * c > 0);
});

// An outline of 1000 vertices with petals.
const flower = (petals, depth, phase) => Array.from({ length: 1000 }, (_, k) => {
  const angle = 2 * Math.PI * k / 1000, radius = 1 + depth * Math.cos(petals * angle + phase);
  return [radius * Math.cos(angle), radius * Math.sin(angle)];
});

test('a map that is overlaid in patches is saved, follows its target and is improved', () => {
  const map = new icc.Map(flower(5, 0.4, 0), flower(4, 0.4, 1)), moved = flower(4, 0.38, 1.05);
  assert.ok(map.report.nInverted > 0 && map.info.nVertices > 2000);
  const loaded = icc.Map.load(map.save());
  for (const goOn of [(m) => m, (m) => m.retarget(moved), (m) => m.improve()]) {
    const one = goOn(map), two = goOn(loaded), mesh = one.mesh();
    assert.equal(one.certified && two.certified, true);
    assert.deepEqual(two.mesh(), mesh);
    assert.equal(two.info.energy, one.info.energy);
    assert.deepEqual(two.certify(mesh.vertices, mesh.simplices), one.certify(mesh.vertices, mesh.simplices));
  }
});

test('a surface that is matched keeps its mesh if asked', () => {
  const corners = [1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1];
  const faces = [0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5];
  const turned = corners.map((x, i) => (i % 3 === 0 ? .8 * x - .6 * corners[i + 1]
    : i % 3 === 1 ? .6 * corners[i - 1] + .8 * x : x));
  const match = new icc.Match(icc.Domain.surface(corners, faces), icc.Domain.surface(turned, faces), [], { keepSource: 1 });
  assert.deepEqual([...match.origins().source].slice(0, 6), [0, 1, 2, 3, 4, 5]);
  assert.deepEqual([...match.source.boundary().vertices].slice(0, 18), corners);
});

test('outlines that do not correspond are matched', () => {
  const match = new icc.Match(SQUARE, [[5, 5], [5, 9], [1, 9], [1, 5], [3, 5]]);
  assert.equal(match.info.nVertices, 5);
  const { source, target } = match.origins();
  assert.deepEqual([...target].sort(), [0, 1, 2, 3, 4]);
  assert.deepEqual([...source].sort(), [-1, 0, 1, 2, 3]);
  near(new icc.Map(match.source, match.target).apply([[1, 1]]), [2, 6]);
  const off = new Float64Array(2), around = match.apply([[0, 1], [4, 4.5]], { off });
  near(around, [1, 6, 5, 9]);
  near(off, [0, 0.5]);
  near(match.inverse(around), [0, 1, 4, 4]);
  assert.deepEqual(icc.Match.load(match.save()).apply([[0, 1], [4, 4.5]]), around);
  assert.throws(() => new icc.Match(SQUARE, SQUARE, [], { turning: 'free' }), { code: 'AMBIGUOUS' });
});

// Two regions that share a border, which bends in the new layer.
const OLD = { north: [[0, 1], [4, 1], [4, 2], [0, 2]], south: [[0, 0], [4, 0], [4, 1], [0, 1]] };
const NEW = { south: [[0, 0], [4, 0], [4, 1], [2, 1.4], [0, 1]], north: [[0, 1], [2, 1.4], [4, 1], [4, 2], [0, 2]] };
const collection = (layer) => ({ type: 'FeatureCollection', features: Object.entries(layer).map(([name, ring]) => (
  { type: 'Feature', properties: { name }, geometry: { type: 'Polygon', coordinates: [[...ring, ring[0]]] } })) });

test('two layers of the same regions become one map', () => {
  for (const coverage of [new icc.Coverage(OLD, NEW), new icc.Coverage(collection(OLD), collection(NEW), { by: 'name' }),
    new icc.Coverage(new Map(Object.entries(OLD)), NEW)]) {
    const { nRegions, nNodes, nSides, nIslands, leastApart } = coverage.info;
    assert.deepEqual([nRegions, nNodes, nSides, nIslands, leastApart.length], [2, 2, 3, 0, 2]);
    assert.deepEqual(coverage.regions, ['north', 'south']);
    assert.deepEqual(coverage.differences, []);
    const map = new icc.Map(coverage.source, coverage.target);
    assert.ok(map.certified);
    near(map.apply([[2, 1], [0, 1]]), [2, 1.4, 0, 1]);
    for (const { hole, source, target } of coverage.rings) {
      assert.equal(hole, false);
      near(map.apply(source), target);
    }
  }
});

test('what only one layer has is told by name', () => {
  const more = { ...NEW, east: [[5, 5], [6, 5], [6, 6]] };
  assert.throws(() => new icc.Coverage(OLD, more), { code: 'TOPOLOGY', message: /region east, near \(5, 5\), is in the target only/ });
  assert.deepEqual(new icc.Coverage(OLD, more, { unmatched: 'leave_out' }).differences,
    [{ kind: 'region', side: 'target', regions: ['east'], place: [5, 5] }]);
  assert.deepEqual(new icc.Coverage(OLD, more, { leftOut: ['east'] }).differences, []);
  const over = { ...NEW, south: [[0, 0], [4, 0], [4, 1.2], [0, 1]] };
  assert.throws(() => new icc.Coverage(OLD, over), { code: 'BOUNDARY', message: /regions north and south overlap/ });
  assert.throws(() => new icc.Coverage(OLD, { north: 7, south: NEW.south }), /region north is neither/);
  assert.throws(() => new icc.Coverage(collection(OLD), NEW, { by: 'county' }), /no property 'county'/);
  const noisy = [0.01, -0.01].map((off) => ({ ...OLD, south: OLD.south.map(([x, y]) => [x + off, y + off]) }));
  const welded = new icc.Coverage(...noisy, { weld: [0.03, 0.03] });
  assert.ok(Math.max(...welded.info.mostMoved) <= 0.03 && new icc.Map(welded.source, welded.target).certified);
});

test('a domain may have several outlines, an island in a lake, and lines that meet', () => {
  const islands = (k) => ({ regions: [[[0, 0], [4, 0], [4, 4], [0, 4]], [[6, 0], [8, 0], [8, 2 * k]]], points: [[2, 2]] });
  const map = new icc.Map(icc.Domain.polygon(null, islands(1)), icc.Domain.polygon(null, islands(1.5)));
  assert.ok(map.certified);
  near(map.apply([[8, 1]]), [8, 1.5]);
  const square = (a, b) => [[a, a], [b, a], [b, b], [a, b]];
  const lake = icc.Domain.polygon(square(0, 6), { regions: [square(2, 4)], holes: [square(1, 5)], lines: [[[2, 2], [4, 4]], [[1, 1], [0, 0]]] });
  assert.deepEqual([lake.info.measure, lake.info.nFaces, lake.info.nJunctions], [24, 3, 4]);
  assert.deepEqual(lake.features().map(({ kind }) => kind), ['region', 'hole', 'line', 'line']);
});

test('vertices of a border slide along it', () => {
  const outline = [[0, 0], [4, 0], [4, 2], [4, 4], [0, 4], [0, 2]];
  const domain = (middle) => icc.Domain.polygon(outline, { lines: [[[0, 2], [middle, 2.2], [4, 2]]] });
  const source = domain(2), target = domain(1), map = new icc.Map(source, target, { slide: 'inside' });
  assert.equal(new icc.Map(source, target).info.nSlid, 0);
  assert.ok(map.certified && map.info.nSlid === 1 && map.info.energy < new icc.Map(source, target).info.energy);
  assert.throws(() => new icc.Map(outline, outline, { slide: 'all' }), { code: 'UNSUPPORTED', message: /slide/ });
});

// A square of 2 x 2 smaller ones, whose middle is vertex 4.
const NET = { vertices: [[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1], [0, 2], [1, 2], [2, 2]],
  simplices: [0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 3, 4, 7, 3, 7, 6, 4, 5, 8, 4, 8, 7] };

test('control points, pins and walls make maps', () => {
  const points = [[0, 0], [4, 0], [4, 3], [0, 3], [2, 1]], to = [[1, 1], [5, 2], [6, 5], [1, 4], [3, 2]];
  const fit = new icc.Fit(points, to), moved = fit.move([...to.slice(0, 4), [3.5, 2]]);
  assert.equal(fit.map.certified, true);
  near(fit.map.apply(points), to.flat(), 1e-9);
  near(moved.map.apply([[2, 1]]), [3.5, 2], 1e-9);
  near(fit.residuals(), Array(10).fill(0), 1e-9);
  assert.ok(fit.leftOut().every(Number.isFinite) && fit.dim === 2);
  assert.equal(fit.info.model, 'spline');
  const wide = new icc.Fit(points, to, null, { box: [[-9, -9], [9, 9]], margin: 0.1, tolerance: 0.1 });
  assert.ok(wide.map.apply([[-9, -9], [9, 9]]).every(Number.isFinite));
  const posed = new icc.Fit([[1, 1], [3, 3]], [[1, 1], [3, 3.5]], SQUARE, { lines: [[[[1, 3], [2, 3]], [[1, 3], [2, 3]]]], reach: 0.2 });
  near(posed.map.apply([[3, 3], [1.5, 3]]), [3, 3.5, 1.5, 3], 1e-9);
  assert.equal(posed.info.model, 'elastic');
  const wall = new icc.Fit(null, null, null, { mesh: NET, vertices: [0, 1, 2, 6, 7, 8], sliding: [3, 5], along: [[0, 1], [0, 1]],
    places: [[0, 0], [1, 0], [2, 0], [0, 3], [1, 3], [2, 3]], stiffness: 1.5, cellStiffness: Array(8).fill(1) });
  const { vertices, images } = wall.map.mesh();
  assert.deepEqual([...vertices], NET.vertices.flat());
  near([images[6], images[10], images[15]], [0, 2, 3], 1e-9);
  assert.throws(() => new icc.Fit(points, to.slice(1)), /5 need targets, but there are 4/);
  assert.throws(() => fit.move([[1, 2]]), /5 need targets/);
  assert.throws(() => new icc.Fit([[9, 9]], [[9, 9]], SQUARE), { code: 'OUTSIDE' });
  const kept = fit.map;
  fit.free();
  assert.throws(() => kept.apply(points), /has been freed/);
});

test('a warp of a mesh becomes one-to-one', () => {
  const { map, report } = icc.Map.nearest(NET.vertices, NET.simplices, NET.vertices);
  assert.deepEqual([...map.mesh().images], NET.vertices.flat());
  assert.equal(report.repair, 'none');
  const images = NET.vertices.map((p, i) => (i === 4 ? [2.5, 1] : p)), folded = icc.Map.nearest(NET.vertices, NET.simplices, images);
  assert.ok(folded.map.certified && folded.report.nFolded > 0);
  assert.throws(() => icc.Map.nearest(NET.vertices, NET.simplices, [1, 2]), /^TypeError: images has 2 numbers/);
});

test('features go to their places', () => {
  const inside = (x) => icc.Domain.polygon(SQUARE, {
    points: [[x, 1]], lines: [[[2, 2], [3, 3]]], holes: [[[1, 2.5], [1.5, 2.5], [1.2, 3]]],
  });
  const map = new icc.Map(inside(1), inside(3));
  assert.equal(map.certified, true);
  near(map.apply([[1, 1]]), [3, 1]);
  assert.equal(new icc.Map(inside(1), inside(3), { ties: map.ties() }).info.classKept, 1);
});

const ringOf = (points) => [...points, points[0]];
const featureOf = (geometry, properties = {}) => ({ type: 'Feature', properties, geometry });
const polygonOf = (...rings) => ({ type: 'Polygon', coordinates: rings.map(ringOf) });

test('polygons of GeoJSON are shapes', () => {
  const before = featureOf(polygonOf(SQUARE)), after = { type: 'FeatureCollection', features: [featureOf(polygonOf(LEANING))] };
  const wanted = new icc.Map(SQUARE, LEANING).apply([[1, 1]]);
  assert.deepEqual(new icc.Map(before, after).apply([[1, 1]]), wanted);
  assert.deepEqual(new icc.Map(before.geometry, after).apply([[1, 1]]), wanted);
  const hole = [[1, 1], [2, 1], [2, 2], [1, 2]], withHole = icc.Domain.polygon(polygonOf(SQUARE, hole), { points: [[3, 3]] });
  assert.deepEqual(withHole.features().map(({ kind }) => kind), ['hole', 'point']);
  const away = SQUARE.map(([x, y]) => [x + 9, y, 7]);
  const parts = icc.Domain.polygon({ type: 'MultiPolygon', coordinates: [[ringOf(SQUARE), ringOf(hole)], [ringOf(away)]] });
  assert.equal(parts.info.measure, 31);
  assert.throws(() => icc.Domain.polygon({ type: 'Point', coordinates: [1, 1] }), /not Point/);
  assert.throws(() => icc.Domain.polygon(featureOf(null)), /without a geometry/);
  assert.throws(() => new icc.Map({ type: 'FeatureCollection', features: [before, before] }, after), /has 2; pass one/);
});

test('objects of GeoJSON are mapped, there and back', () => {
  const map = new icc.Map(SQUARE, SQUARE.map(([x, y]) => [2 * x, y]));
  const line = { type: 'LineString', coordinates: [[1, 1, 50], [3, 1, 60]] };
  const layer = {
    type: 'FeatureCollection', name: 'layer', bbox: [0, 0, 4, 4],
    features: [featureOf(line, { id: 1 }), featureOf(polygonOf(SQUARE)), featureOf({ type: 'Point', coordinates: [9, 9] }), featureOf(null),
      featureOf({ type: 'GeometryCollection', geometries: [{ type: 'MultiPoint', coordinates: [[1, 1], [2, 3]] }, line] })],
  };
  const text = JSON.stringify(layer), images = map.geojson(layer);
  assert.equal(JSON.stringify(layer), text);
  assert.deepEqual([images.name, images.bbox, images.features[0].properties], ['layer', undefined, { id: 1 }]);
  near(images.features[0].geometry.coordinates.flat(), [2, 1, 50, 6, 1, 60]);
  assert.deepEqual(images.features[1].geometry.coordinates[0][0], images.features[1].geometry.coordinates[0][4]);
  assert.deepEqual(images.features.slice(2, 4).map(({ geometry }) => geometry), [null, null]);
  near(images.features[4].geometry.geometries[0].coordinates.flat(), [2, 1, 4, 3]);
  near(map.geojson(images, { inverse: true }).features[0].geometry.coordinates.flat(), [1, 1, 50, 3, 1, 60]);
  near(map.geojson(line, { segment: 1 }).coordinates.flat(), [2, 1, 50, 4, 1, 55, 6, 1, 60]);
  assert.equal(map.geojson({ type: 'MultiPoint', coordinates: [[1, 1], [3, 1]] }, { segment: 0.1 }).coordinates.length, 2);
  assert.equal(map.geojson({ type: 'Point', coordinates: [9, 9] }), null);
  assert.throws(() => map.geojson([[1, 1]]), /no object of GeoJSON/);
  assert.throws(() => map.geojson({ type: 'Circle', coordinates: [1, 1] }), /'Circle' is no type/);
  assert.throws(() => map.geojson(line, { segment: 0 }), /segment is 0/);
});

/** A BufferGeometry as three.js has it: the faces of a cube do not share vertices. */
function cubeGeometry() {
  const corners = Array.from({ length: 8 }, (_, k) => [k & 1, (k >> 1) & 1, k >> 2]);
  const faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
  const array = Float32Array.from(faces.flat().flatMap((k) => corners[k]));
  const position = { itemSize: 3, count: 24, array, getX: (i) => array[3 * i], getY: (i) => array[3 * i + 1], getZ: (i) => array[3 * i + 2],
    setXYZ: (i, ...at) => array.set(at, 3 * i) };
  const list = faces.flatMap((_, f) => [0, 1, 2, 0, 2, 3].map((k) => 4 * f + k));
  const geometry = { attributes: { position, normal: {} }, index: { count: 36, getX: (i) => list[i] }, normals: 0 };
  geometry.computeVertexNormals = () => { geometry.normals += 1; };
  return geometry;
}

test('meshes of three.js are surfaces, and bent', async () => {
  const { surfaceOf, bend } = await at('three.js'), geometry = cubeGeometry();
  const { vertices, facets } = surfaceOf(geometry);
  assert.deepEqual([vertices.length, facets.length], [24, 36]);
  const map = new icc.Map(icc.Domain.surface(vertices, facets), icc.Domain.surface(vertices.map((v) => 2 * v), facets));
  assert.equal(bend(geometry, map), 0);
  assert.deepEqual([Math.max(...geometry.attributes.position.array), geometry.normals, geometry.attributes.position.needsUpdate], [2, 1, true]);
  assert.ok(bend(geometry, map) > 0, 'the corners are outside now');
  assert.throws(() => surfaceOf({ attributes: {} }), /no BufferGeometry/);
});

test('a canvas shows a warped picture', async () => {
  const { drawWarped } = await at('canvas.js');
  const data = Uint8ClampedArray.from({ length: 64 }, (_, i) => (i % 4 === 3 ? 255 : 3 * i));
  let shown = null;
  globalThis.ImageData = class { constructor(width, height) { Object.assign(this, { width, height, data: new Uint8ClampedArray(4 * width * height) }); } };
  drawWarped({ width: 4, height: 4, getContext: () => ({ putImageData: (image) => { shown = image; } }) },
    new icc.Map(SQUARE, SQUARE), { width: 4, height: 4, data });
  delete globalThis.ImageData;
  assert.deepEqual(shown.data, data);
});

test('a picture is warped; the identity copies it', () => {
  const data = Uint8ClampedArray.from({ length: 64 }, (_, i) => (i % 4 === 3 ? 255 : 3 * i));
  const source = { width: 4, height: 4, data };
  const target = { width: 4, height: 4, data: new Uint8ClampedArray(64) };
  new icc.Map(SQUARE, SQUARE).warp(source, target);
  assert.deepEqual(target.data, source.data);
});

test('a picture that is not as large as it says is refused, and the instance stays sound', () => {
  const map = new icc.Map(SQUARE, SQUARE), full = () => ({ width: 4, height: 4, data: new Uint8ClampedArray(64).fill(9) });
  const bad = [
    [{ data: new Uint8ClampedArray(0) }, /data has 0 bytes, but 4 x 4 pixels of RGBA are 64/],
    [{ data: new Uint8ClampedArray(48) }, /data has 48 bytes, but 4 x 4 pixels of RGBA are 64/],
    [{ data: new Uint8ClampedArray(65) }, /data has 65 bytes/],
    [{ data: new Float32Array(64) }, /data must be a Uint8ClampedArray/],
    [{ data: new Float32Array(16) }, /data must be a Uint8ClampedArray/],
    [{ data: Array(64).fill(0) }, /data must be a Uint8ClampedArray/],
    [{ data: undefined }, /data must be a Uint8ClampedArray/],
    [{ width: 3.5 }, /width is 3.5, but must be a whole number of at least 1/],
    [{ width: 0 }, /width is 0/], [{ height: -4 }, /height is -4/], [{ height: '4' }, /height is '4'/], [{ width: NaN }, /width is NaN/],
  ];
  for (const [change, message] of bad) {
    const target = full();
    assert.throws(() => map.warp({ ...full(), ...change }, target), (e) => e instanceof TypeError && message.test(e.message)
      && e.message.startsWith('source.'), String(message));
    assert.throws(() => map.warp(full(), { ...target, ...change }), (e) => e instanceof TypeError && message.test(e.message)
      && e.message.startsWith('target.'), String(message));
    assert.ok(target.data.every((v) => v === 9));
  }
  assert.throws(() => map.warp(null, full()), /source is null/);
  assert.throws(() => map.warp(full(), undefined), /target is undefined/);
  assert.equal(map.warp(full(), { width: 2, height: 2, data: new Uint8Array(16) }).data[5], 9);
  assert.equal(new icc.Map(SQUARE, LEANING).certified, true);
});

test('arrays of the wrong length or type are refused, and so are numbers that are not whole', () => {
  const map = new icc.Map(SQUARE, LEANING), chart = new icc.Chart(SQUARE), wrong = (work, message) =>
    assert.throws(work, (e) => (e instanceof TypeError || e instanceof RangeError) && message.test(e.message), String(message));
  for (const name of ['apply', 'inverse', 'jacobian']) {
    for (const status of [[], [0, 0], new Int32Array(1), new Int32Array(3), new Float64Array(2)])
      wrong(() => map[name]([[1, 1], [2, 2]], { status }), /^status must be a Int32Array of length 2, not/);
    wrong(() => map[name]([[1, 1]], { out: [0, 0] }), /^out must be a Float64Array of length/);
    wrong(() => map[name]([[1, 1]], { out: new Float32Array(2) }), /^out must be a Float64Array/);
  }
  const status = new Int32Array(2);
  map.apply([[1, 1], [9, 9]], { status });
  assert.deepEqual([...status].map(icc.codeOf), ['OK', 'OUTSIDE']);
  const { facet, bary, t } = chart.encode([[1, 1], [2, 3]]);
  wrong(() => chart.decode({ facet: facet.subarray(1), bary, t }), /^facet has 1 numbers, but 2 are needed/);
  wrong(() => chart.decode({ facet, bary: bary.subarray(1), t }), /^bary has 3 numbers, but 4/);
  wrong(() => chart.decode({ facet, bary }), /^t must be an array/);
  for (const point of [[], [1], [1, 1, 2, 2]]) wrong(() => chart.trace(point), /numbers/);
  wrong(() => new icc.Chart(SQUARE, { method: 'gradient', maximum: [1] }), /numbers/);
  wrong(() => new icc.Map(SQUARE, SQUARE, { targetMaximum: [1] }), /numbers/);
  wrong(() => new icc.Map(SQUARE, SQUARE, { iterations: 1.5 }), /icc_map_options.iterations is 1.5, but has to be a whole number/);
  wrong(() => new icc.Map(SQUARE, SQUARE, { iterations: 'ten' }), /iterations is ten, but has to be a number/);
  wrong(() => map.retarget(SQUARE, NaN), /icc_retarget_options.iterations is NaN/);
  wrong(() => map.certify([[0, 0], [1, 0], [0, 1]], [0, 1]), /2 indices are no rows of 3/);
  wrong(() => map.certify([[0, 0], [1, 0], [0, 1]], new DataView(new ArrayBuffer(12))), /indices are an array/);
  wrong(() => icc.Domain.mask([2.5, 4], new Uint8Array(10)), /shape\[0\] is 2.5/);
  wrong(() => icc.Domain.mask([-1, -1], new Uint8Array(1)), /shape\[0\] is -1/);
  wrong(() => icc.repairMask([4, 4], new Uint8Array(15)), /^cells has 15 numbers, but 16/);
  wrong(() => icc.repairMask([2, 2], [1, 0, 0, 1]), /icc_mask_repair: cells must be a Uint8Array/);
  wrong(() => icc.triangulate(3.5, SQUARE), /nBoundary is 3.5/);
  wrong(() => new icc.Match(SQUARE, SQUARE, [1, 1, 2]), /3 numbers are no landmarks of 4/);
  wrong(() => new icc.Match(SQUARE, [...SQUARE, [0, 2]]).apply([[0, 1]], { off: new Float64Array(2) }), /^off must be a Float64Array of length 1/);

  const grid = new icc.Grid(icc.Domain.polygon(SQUARE), 12), n = grid.info.nVertices;
  const tree = new icc.Tree(grid, grid.findMaximum().vertex), short = new Float64Array(n - 1);
  wrong(() => icc.Grid.mask([4, 4], new Uint8Array(3)), /^inside has 3 numbers, but 16/);
  wrong(() => grid.restrict(new Uint8Array(3)), /^keep has 3 numbers/);
  wrong(() => grid.findNearest([1]), /numbers/);
  wrong(() => new icc.Grid(icc.Domain.polygon(SQUARE), 12.5), /icc_grid_create: cells is 12.5/);
  wrong(() => icc.Tree.fromParents(grid, tree.root, tree.parents().subarray(1)), /^parents has/);
  wrong(() => new icc.Tree(grid, tree.root, { axisOrder: [0] }), /^axisOrder has 1 numbers, but 2/);
  wrong(() => tree.grow(short), /^values has/);
  wrong(() => tree.rankReport(tree.parents().subarray(1)), /^rank has/);
  wrong(() => icc.GridFunction.fromValues(tree, short), /^values has/);
  wrong(() => icc.GridFunction.fromLogs(tree, short), /^logs has/);

  const handles = [[1, 1], [3, 1], [2, 3]], sampling = new icc.Sampling(new icc.Shape([icc.Domain.polygon(SQUARE)]), { spacing: 0.5 });
  const weights = new icc.Weights(sampling, handles), binding = weights.bind([[2, 2]], { derivatives: true }), pose = new icc.Pose(handles);
  wrong(() => weights.evaluate([[1, 1]], { gradients: new Float64Array(2) }), /^gradients must be a Float64Array of length 6/);
  wrong(() => weights.paint(0, [], 1, 1), /one point has 2 numbers, not 0/);
  wrong(() => weights.repaint([0, 1], [1, 2]), /^values has 2 numbers, but 6/);
  wrong(() => weights.stiffen([0, 1, 2], Float64Array.of(1)), /^rigidity has 1 numbers, but 3/);
  wrong(() => binding.pose(new icc.Pose(handles.slice(1))), /has 12 numbers, but 18/);
  wrong(() => binding.pose({ transforms: new Float64Array(18) }), /must be a Pose/);
  wrong(() => binding.pose(pose, { jacobians: new Float64Array(1) }), /^jacobians must be a Float64Array of length 4/);
  wrong(() => pose.move(0, []), /one point has 2 numbers, not 0/);
  wrong(() => pose.move(0.5, [1, 1]), /handle is 0.5/);
  wrong(() => pose.move(3, [1, 1]), /there is no handle 3/);
  wrong(() => new icc.Weights(sampling, handles, { initial: 'given', initialWeights: [1, 2] }), /^initialWeights has 2 numbers/);
  assert.ok(binding.pose(pose, { jacobians: new Float64Array(4) }).every(Number.isFinite));
});

test('an array in a struct may be larger than the memory', async () => {
  const own = await load(), picture = { width: 2000, height: 1500, data: new Uint8ClampedArray(4 * 2000 * 1500).fill(7) };
  const before = own.memoryBytes, target = { ...picture, data: new Uint8ClampedArray(picture.data.length) };
  const frame = [[0, 0], [2000, 0], [2000, 1500], [0, 1500]];
  new own.Map(frame, frame).warp(picture, target);
  assert.ok(own.memoryBytes > before && target.data.every((v) => v === 7));
});

test('a surface is filled, and mapped', () => {
  const cube = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [i & 1, (i >> 1) & 1, i >> 2]);
  const faces = [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4], [2, 6, 3], [3, 6, 7],
    [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]];
  const sheared = cube.map(([x, y, z]) => [x + z, y, z]);
  const map = new icc.Map(icc.Domain.surface(cube, faces), icc.Domain.surface(sheared, faces));
  assert.equal(map.certified, true);
  near(map.apply([[0.5, 0.5, 0.5]]), [1, 0.5, 0.5], 0.2);
  assert.ok(icc.Domain.surface(cube, faces).fill().info.nMeshSimplices >= 5);
  const moved = map.improve({ iterations: 2, levels: -1 }).retarget(icc.Domain.surface(cube, faces));
  assert.equal(moved.dim, 3);
  assert.equal(icc.Map.load(moved.save()).retarget(icc.Domain.surface(sheared, faces)).certified, true);
});

test('charts, and the stages by themselves', () => {
  const chart = new icc.Chart(SQUARE, { method: 'foliation' });
  near(chart.decode(chart.encode([[1, 1]])).points, [1, 1]);
  assert.ok(chart.trace([1, 1]).length > 4);
  assert.ok(chart.details.nMeshSimplices > 0);
  const grid = new icc.Grid(icc.Domain.polygon(SQUARE), 20);
  const { vertex, rounds } = grid.findMaximum();
  assert.equal(rounds, 9); // 20 vertices across: the two in the middle are the tenth from either side
  const tree = new icc.Tree(grid, vertex);
  assert.equal(tree.report().nCousinViolations, 0);
  const laplace = new icc.GridFunction(tree, { function: 'laplace' });
  assert.equal(laplace.values()[tree.root], 1);
  assert.equal(laplace.report().nMaxima, 1);

  const again = icc.Tree.fromParents(grid, vertex, tree.parents());
  assert.deepEqual(again.generations(), tree.generations());
  const inside = grid.inside(), values = laplace.values();
  const own = icc.GridFunction.fromValues(again, values.map((value, v) => (inside[v] ? value : NaN)));
  assert.equal(own.info.function, 'values');
  near(icc.GridFunction.fromLogs(tree, laplace.logs()).values().filter((_, v) => inside[v]), values.filter((_, v) => inside[v]), 1e-12);
  const down = new icc.Curves(own, [[1, 1], [-9, 0]], 'down');
  assert.deepEqual(down.ends().end, ['boundary', 'none']);
  near(down.vertices()[0].slice(0, 2), [1, 1]);
  near(new icc.Curves(own, [[1, 1]]).vertices()[0].slice(-2), grid.points([vertex]));
  const solved = icc.GridFunction.solve(tree, { function: 'laplace' }, Array.from(inside, (_, v) => (v === vertex ? 1 : NaN)));
  near(solved.values().filter((_, v) => inside[v]), values.filter((_, v) => inside[v]), 1e-12);
  const { facets, kinds, report } = laplace.facets(), edges = laplace.edges();
  assert.deepEqual(facets, edges.edges);
  assert.deepEqual(kinds, edges.kinds);
  assert.equal(report.nTested, edges.tested);
  assert.deepEqual(laplace.facetReport(), report);
  const ordered = icc.Chart.fromFunction(new icc.GridFunction(new icc.Tree(grid, vertex, { axisOrder: [1, 0] })));
  const same = new icc.Chart(SQUARE, { method: 'gradient', cells: 20, axisOrder: [1, 0] });
  assert.deepEqual(ordered.encode([[1, 1], [1, 3]]), same.encode([[1, 1], [1, 3]]));
  assert.deepEqual(icc.Chart.load(ordered.save()).save(), ordered.save());
  assert.throws(() => new icc.Chart(SQUARE, { method: 'gradient', axisOrder: [1, 1] }), { code: 'ARGUMENT' });
  assert.throws(() => new icc.Curves(own, [[1, 1]], 'sideways'), /'sideways' is none of 'up', 'down'/);
});

test('kernel coordinates: weights, poses, painting', () => {
  const handles = [[1, 1], [3, 1], [2, 3]];
  const shape = new icc.Shape([icc.Domain.polygon(SQUARE)]);
  const sampling = new icc.Sampling(shape, { spacing: 0.3, fixed: handles });
  const weights = new icc.Weights(sampling, handles, { method: 'qp', edges: [[0, 1]] });
  const values = weights.evaluate([[2, 2]]);
  near([values[0] + values[1] + values[2]], [1], 1e-9);
  const binding = weights.bind([[2, 2]]), pose = new icc.Pose(handles);
  near(binding.pose(pose), [2, 2], 1e-9);
  for (const handle of [0, 1, 2]) pose.move(handle, [1, 0]);
  near(binding.pose(pose), [3, 2], 1e-9);
  assert.notDeepEqual(weights.paint(0, [2, 2], 1, 0.5).evaluate([[2, 2]]), values);
  assert.ok(Math.abs(weights.dual(1, weights.nodes().points.slice(2, 4))[0] - 1) < 1e-9);
  assert.equal(weights.withMethod('equality').info.method, 'equality');
  assert.deepEqual(icc.Sampling.load(sampling.save()).points(), sampling.points());
});

test('errors name what is at fault', () => {
  assert.throws(() => icc.Domain.polygon(CROSSED), (e) => e instanceof IccError && e.code === 'BOUNDARY' &&
    e.item === 'facet' && e.index === 0 && /edges 0 and 2/.test(e.message));
  assert.deepEqual(icc.boundaryDefects(CROSSED), [{ kind: 'crossing', a: 0, b: 2 }]);
  assert.throws(() => new icc.Map(SQUARE, LEANING, { knid: 'mesh' }), /no member knid, only kind, iterations, chart, /);
  assert.throws(() => new icc.Map(SQUARE, LEANING, { kind: 'mehs' }), /none of 'curves', 'mesh'/);
  assert.throws(() => new icc.Map(SQUARE, LEANING).apply([[1, 1]], { out: new Float64Array(3) }), /length 2/);
});

test('what is freed is gone, and a loop of maps needs no more memory', () => {
  const map = new icc.Map(SQUARE, LEANING);
  map.free();
  map.free();
  assert.throws(() => map.info, /has been freed/);
  const once = () => {
    const made = new icc.Map(SQUARE, LEANING, { iterations: -1 });
    made.apply([[1, 1]]);
    made.free();
  };
  for (let i = 0; i < 20; ++i) once();
  const before = icc.memoryBytes;
  for (let i = 0; i < Number(process.env.ICC_MAPS ?? 500); ++i) once();
  assert.equal(icc.memoryBytes, before);
});
