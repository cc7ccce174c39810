// Cages as text ("x y" lines, blank lines between rings), GeoJSON and SVG paths; and back.
import { outlineOf, withPart } from './shape.js';

const NUMBER = /[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?/g;

const unclosed = (ring) => {
  const [a, b] = [ring[0], ring.at(-1)];
  return ring.length > 1 && a[0] === b[0] && a[1] === b[1] ? ring.slice(0, -1) : ring;
};

function shapeOf([outer, ...inner]) {
  if (!outer || outer.length < 3) throw new Error('There is no ring of three corners or more in this file.');
  return inner.reduce((shape, points) => withPart(shape, { kind: 'hole', points }), outlineOf(outer));
}

function fromText(text) {
  const rings = [[]];
  for (const line of text.split(/\r?\n/)) {
    const found = line.replace(/#.*/, '').match(NUMBER);
    if (!found) { if (rings.at(-1).length > 0) rings.push([]); continue; }
    if (found.length !== 2) throw new Error(`A line with ${found.length} numbers: "${line.slice(0, 40)}".`);
    rings.at(-1).push(found.map(Number));
  }
  return shapeOf(rings.map(unclosed).filter((ring) => ring.length > 2));
}

function fromGeoJson(text) {
  const geometries = [];
  const collect = (value) => {
    if (value?.type === 'FeatureCollection') value.features.forEach(collect);
    else if (value?.type === 'Feature') collect(value.geometry);
    else if (value?.type === 'GeometryCollection') value.geometries.forEach(collect);
    else if (value?.type?.startsWith('Multi'))
      value.coordinates.forEach((coordinates) => collect({ type: value.type.slice(5), coordinates }));
    else if (value?.type) geometries.push(value);
  };
  collect(JSON.parse(text));
  const flatten = (ring) => ring.map(([x, y]) => [x, y]);
  const polygon = geometries.find((g) => g.type === 'Polygon');
  if (!polygon) throw new Error('There is no polygon in this file.');
  let shape = shapeOf(polygon.coordinates.map((ring) => unclosed(flatten(ring))));
  for (const { type, coordinates } of geometries) {
    if (type === 'LineString') shape = withPart(shape, { kind: 'line', points: flatten(coordinates) });
    if (type === 'Point') shape = withPart(shape, { kind: 'point', points: flatten([coordinates]) });
  }
  return shape;
}

/** Rings of a path: straight pieces as they are, along curves a corner every few units. */
function fromPath(path, make) {
  return shapeOf((path.match(/[mM][^mM]*/g) ?? []).map((part) => {
    const corners = straight(part);
    if (corners) return corners;
    const element = make('path', { d: part });
    const length = element.getTotalLength(), n = Math.min(400, Math.max(12, Math.round(length / 12)));
    return Array.from({ length: n }, (_, i) => {
      const { x, y } = element.getPointAtLength((i / n) * length);
      return [x, y];
    });
  }));
}

/** The corners of a path of straight pieces, or null. */
function straight(path) {
  if (/[cCsSqQtTaA]/.test(path)) return null;
  const corners = [];
  let x = 0, y = 0;
  for (const [, command, list] of path.matchAll(/([mMlLhHvVzZ])([^a-zA-Z]*)/g)) {
    const numbers = (list.match(NUMBER) ?? []).map(Number);
    const relative = command === command.toLowerCase(), kind = command.toLowerCase();
    for (let i = 0; i < numbers.length; i += kind === 'h' || kind === 'v' ? 1 : 2) {
      const dx = kind === 'v' ? (relative ? 0 : x) : numbers[i];
      const dy = kind === 'h' ? (relative ? 0 : y) : numbers[kind === 'v' ? i : i + 1];
      [x, y] = relative ? [x + dx, y + dy] : [dx, dy];
      corners.push([x, y]);
    }
  }
  return unclosed(corners);
}

/** A shape from the text of a file; `make` makes elements of SVG. */
export function readShape(text, make) {
  const head = text.trimStart();
  if (head.startsWith('{')) return fromGeoJson(text);
  if (head.startsWith('<')) {
    const document = new DOMParser().parseFromString(text, 'image/svg+xml');
    const element = document.querySelector('path[d], polygon[points]');
    if (!element) throw new Error('There is no path and no polygon in this drawing.');
    return element.matches('path') ? fromPath(element.getAttribute('d'), make) : fromPath(`M${element.getAttribute('points')}Z`, make);
  }
  return /^[mM]/.test(head) ? fromPath(head, make) : fromText(text);
}

const line = ([x, y]) => `${+x.toFixed(6)} ${+y.toFixed(6)}`;

/** The rings as text: what the command `libicc` reads. */
export const writeText = (shape) => `${shape.filter((p) => p.kind === 'outline' || p.kind === 'hole')
  .map((part) => part.points.map(line).join('\n')).join('\n\n')}\n`;

/** All parts as GeoJSON. */
export function writeGeoJson(shape) {
  const closed = (ring) => [...ring, ring[0]];
  const feature = (geometry) => ({ type: 'Feature', properties: {}, geometry });
  const rings = shape.filter((p) => p.kind === 'outline' || p.kind === 'hole').map((p) => closed(p.points));
  return `${JSON.stringify({
    type: 'FeatureCollection',
    features: [feature({ type: 'Polygon', coordinates: rings }),
      ...shape.filter((p) => p.kind === 'line').map((p) => feature({ type: 'LineString', coordinates: p.points })),
      ...shape.filter((p) => p.kind === 'point').map((p) => feature({ type: 'Point', coordinates: p.points[0] }))],
  })}\n`;
}
