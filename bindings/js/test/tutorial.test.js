// The blocks of JavaScript in the documentation, with stand-ins for what a page has.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import test from 'node:test';
import { pathToFileURL } from 'node:url';

const { load, AsyncIcc } = await import(pathToFileURL(`${process.env.ICC_PACKAGE}/src/index.js`));
const text = ['tutorials/browser', 'howto/handles', 'howto/drag']
  .map((page) => fs.readFileSync(new URL(`../../../docs/${page}.md`, import.meta.url), 'utf8')).join('\n');

test('every block of JavaScript runs', async () => {
  const blocks = [...text.matchAll(/^```js\n([^]*?)^```$/gm)].map(([, block]) => block);
  assert.ok(blocks.length >= 7);
  const printed = [], drawn = [], bar = {}, stop = {}, canvas = {};
  const cage = [[0, 0], [4, 0], [4, 4], [2, 5], [0, 4]];
  const moved = (outline, { by }) => outline.map(([x, y], i) => (i === 3 ? [x, y + by] : [x, y]));
  // One name is declared in several blocks.
  const called = blocks.map((block) => (block.includes('function frame(') ? `${block}frame(moved(cage, { by: 0.1 }));` : block));
  const code = `${called.join('\n').replace(/^(const|let) /gm, 'var ').replace(/^import .*$/gm, '')}\nreturn { icc, chart };`;
  const make = Object.getPrototypeOf(async () => {}).constructor;
  const parameters = { load, AsyncIcc, cage, moved, canvas, bar, stop, points: [[1, 1], [2, 2]],
    draw: (...what) => drawn.push(what), console: { log: (...what) => printed.push(what) } };
  const { icc, chart } = await make(...Object.keys(parameters), code)(...Object.values(parameters));
  assert.deepEqual(printed[0], [true]);
  assert.deepEqual(printed[2][0].map((v) => Math.round(v * 1e9) / 1e9), Float64Array.of(1, 1));
  assert.deepEqual(printed[3].slice(0, 2), ['BOUNDARY', 0]);
  assert.match(printed[3][2], /^edges 0 and 2 cross/);
  assert.equal(drawn.length, 2); // a frame, and a pose
  assert.equal(bar.value, 1);
  assert.equal((await chart.info).method, 'gradient');
  const before = drawn.length;
  await Promise.all([0.1, 0.2, 0.3].map((by) => canvas.onpointermove({ by })));
  assert.equal(drawn.length - before, 2); // the first and the latest
  icc.close();
});

test('the page about GeoJSON: its block of JavaScript carries the points of its files', async () => {
  const page = fs.readFileSync(new URL('../../../docs/howto/geojson.md', import.meta.url), 'utf8');
  const file = (name) => JSON.parse(new RegExp(`<!-- file: ${name} -->\n\`\`\`json\n([^]*?)\`\`\``).exec(page)[1]);
  const [, block] = /^```js\n([^]*?)^```$/m.exec(page), icc = await load(), island = file('island.geojson'), data = file('data.geojson');
  new Function('icc', 'island', 'data', block)(icc, island, data);
  const [town, road, lake, buoy] = data.features.map((feature) => feature.geometry);
  assert.deepEqual(town.coordinates.map((v) => v.toFixed(2)), ['5.32', '4.37']); // as in the page's block of Python
  assert.deepEqual([road.type, lake.type, buoy], ['LineString', 'Polygon', null]);
  assert.throws(() => icc.Domain.polygon(file('island.geojson').features[0].geometry.coordinates),
    /these are rings, not points: of a polygon of GeoJSON pass coordinates\[0\]/);
});

test("the README's example of a status", async () => {
  const readme = fs.readFileSync(new URL('../README.md', import.meta.url), 'utf8'), printed = [];
  const [, block] = /^```js\n(const status[^]*?)^```$/m.exec(readme), icc = await load();
  const [, example] = /^(    import [^]*?)\n\n/m.exec(readme), lines = example.split('\n').slice(2).join('\n');
  new Function('icc', 'console', `${lines}\n${block}`)(icc, { log: (...what) => printed.push(what) });
  assert.equal(printed[0][0], true);
  assert.deepEqual(printed[1], [['OK', 'OUTSIDE']]);
});
