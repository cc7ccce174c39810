// Gives the studio in the pages the shapes and pictures of these: what is at studio.html#NAME in the HTML that Doxygen
// has made becomes a link with the state in it, as the studio itself writes them. Needs python3 with NumPy for shapes that
// the pages compute; without it those pages have the studio as it opens.
// usage: node docs/live.js HTML        (from cmake --preset docs)
import { execFileSync, spawnSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import zlib from 'node:zlib';

const [html] = process.argv.slice(2);
const top = path.resolve(path.dirname(new URL(import.meta.url).pathname), '..');
const SIZE = 640, MARGIN = 48; // of the studio's own pictures
const ORDER = ['outline', 'hole', 'line', 'point'];

const read = (file) => fs.readFileSync(path.join(top, file), 'utf8');
const picture = (file) => `data:image/png;base64,${fs.readFileSync(path.join(top, file), 'base64')}`;

/** A file that a tutorial shows, and its first block of Python. */
const shown = (page, name) => new RegExp(`<!-- file: ${name} -->\n\`\`\`\\w+\n([^]*?)\`\`\``).exec(read(`docs/${page}.md`))[1];
const program = (page) => /```python\n([^]*?)```/.exec(read(`docs/${page}.md`))[1];

/** The Python that has NumPy: the first one found, or the system's. */
const hasNumpy = (python) => spawnSync(python, ['-c', 'import numpy']).status === 0;
const python = ['python3', '/usr/bin/python3'].find(hasNumpy) ?? 'python3';

/** A file that a program of Python writes. */
function computed(name, ...args) {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'live-'));
  try {
    execFileSync(python, args.map((arg) => arg.replace('FOLDER', folder)), { cwd: folder, stdio: 'pipe' });
    return fs.readFileSync(path.join(folder, name), 'utf8');
  } finally {
    fs.rmSync(folder, { recursive: true });
  }
}
const example = (name, file) => computed(file, path.join(top, 'examples', name), 'FOLDER');

/** "x y" lines as an outline. */
const fromText = (text) => [{ kind: 'outline', points: text.trim().split('\n').map((line) => line.trim().split(/\s+/).map(Number)) }];

/** The parts of one role in GeoJSON, in the studio's order. */
function fromGeoJson(text, role) {
  const parts = JSON.parse(text).features.filter(({ properties }) => properties.role === role).flatMap(({ properties, geometry }) => {
    const { type, coordinates } = geometry, { feature = 0 } = properties;
    if (type === 'Polygon')
      return coordinates.map((ring, k) => ({ kind: k === 0 ? 'outline' : 'hole', points: ring.slice(0, -1), feature }));
    return [{ kind: type === 'Point' ? 'point' : 'line', points: type === 'Point' ? [coordinates] : coordinates, feature }];
  });
  return parts.sort((a, b) => ORDER.indexOf(a.kind) - ORDER.indexOf(b.kind) || a.feature - b.feature)
    .map(({ kind, points }) => ({ kind, points: points.map(([x, y]) => [x, y]), ...(kind === 'point' ? { radius: 0 } : {}) }));
}

const both = (text) => ({ source: fromGeoJson(text, 'source'), target: fromGeoJson(text, 'target') });

const boxOf = (shape) => shape[0].points.reduce(([a, b, c, d], [x, y]) =>
  [Math.min(a, x), Math.min(b, y), Math.max(c, x), Math.max(d, y)], [Infinity, Infinity, -Infinity, -Infinity]);

/** Shapes with y upwards, in the studio's picture: by one scale where they lie over each other, else each by its own. */
function fitted({ source, target }) {
  const [s, t] = [boxOf(source), boxOf(target)];
  const over = [0, 1].every((a) => s[a] <= t[a + 2] && t[a] <= s[a + 2]);
  const common = [0, 1, 2, 3].map((k) => (k < 2 ? Math.min : Math.max)(s[k], t[k]));
  const placed = (shape, [left, bottom, right, upper]) => {
    const scale = (SIZE - 2 * MARGIN) / Math.max(right - left, upper - bottom);
    const at = ([x, y]) => [SIZE / 2 + (x - (left + right) / 2) * scale, SIZE / 2 - (y - (bottom + upper) / 2) * scale];
    return shape.map((part) => ({ ...part, points: part.points.map(at) }));
  };
  return { source: placed(source, over ? common : s), target: placed(target, over ? common : t) };
}

const drawn = (shapes) => ({ mode: 'cage', sample: 'squares', ...fitted(shapes) });
const photo = (shapes) => ({ mode: 'cage', picture: picture('examples/data/chelsea.png'), ...shapes });

/** The outlines in a tutorial's JavaScript. */
function outlines() {
  const [, source, target] = /square = (\[.*\]), leaning = (\[.*\]);/.exec(read('docs/tutorials/browser.md'));
  return { source: [{ kind: 'outline', points: JSON.parse(source) }], target: [{ kind: 'outline', points: JSON.parse(target) }] };
}

/** With a source in pixels, which count downwards. */
const upwards = ({ source, target }) =>
  ({ source: source.map((part) => ({ ...part, points: part.points.map(([x, y]) => [x, -y]) })), target });

/** The cages that `libicc demo` writes, and its picture: docs/images/fish.png. */
const FISH = {
  before: [30, 55, 115, 105, 190, 62, 262, 40, 345, 72, 425, 160, 345, 248, 262, 275, 190, 258, 115, 215, 30, 265, 58, 160],
  after: [92, 58, 136, 134, 200, 106, 252, 86, 314, 102, 414, 146, 373, 262, 274, 312, 180, 296, 100, 238, 8, 234, 65, 162],
};
const pairs = (numbers) => [{ kind: 'outline', points: numbers.flatMap((x, k) => (k % 2 ? [] : [[x, numbers[k + 1]]])) }];
const data = (name) => fromText(read(`examples/data/${name}`));

/** name -> the state to begin with */
const STATES = {
  fish: () => ({ ...photo({ source: pairs(FISH.before), target: pairs(FISH.after) }), picture: picture('docs/images/fish.png') }),
  eye: () => photo(both(computed('eye.geojson', '-c', program('howto/photograph')))),
  character: () => drawn(both(example('character.py', 'character.geojson'))),
  county: () => drawn(both(example('county.py', 'county.geojson'))),
  parish: () => drawn(upwards(both(example('cadastre.py', 'parish.geojson')))),
  island: () => drawn(both(shown('howto/geojson', 'island.geojson'))),
  square: () => drawn(outlines()),
  tripus: () => ({ ...drawn({ source: data('tripus.src.txt'), target: data('tripus.tgt.txt') }), mode: 'stages' }),
  star: () => ({ ...drawn({ source: data('star.txt'), target: data('star.txt') }), mode: 'handles', rig: 'cage' }),
  pins: () => ({ ...STATES.fish(), target: pairs(FISH.before), mode: 'handles', rig: 'cage' }),
};

const rounded = (key, value) => (typeof value === 'number' ? Math.round(value * 1000) / 1000 : value);
const linkOf = (state) => `s=${zlib.deflateRawSync(JSON.stringify(state, rounded), { level: 9 }).toString('base64url')}`;

function link(name) {
  try {
    return linkOf(STATES[name]());
  } catch (error) {
    if (error.status === undefined) throw error; // a program that failed, for want of NumPy
    console.log(`the studio is not given ${name}: ${error.message.split('\n')[0]}`);
    return 'cage';
  }
}

const given = new Set();
for (const file of fs.readdirSync(html).filter((name) => name.endsWith('.html'))) {
  const text = fs.readFileSync(path.join(html, file), 'utf8');
  const made = text.replace(/src="studio\.html#(\w+)"/g, (whole, name) => {
    if (!Object.hasOwn(STATES, name)) return whole;
    given.add(name);
    return `src="studio.html#${link(name)}"`;
  });
  if (made !== text) fs.writeFileSync(path.join(html, file), made);
}
console.log(`${given.size} of ${Object.keys(STATES).length} shapes are in the pages`);
if (given.size < Object.keys(STATES).length) process.exit(1);
