// Checks the caller's points and numbers. A value that is not a number is refused.

const show = (value) => (typeof value === 'string' ? `'${value}'` : typeof value === 'object' && value !== null
  ? `an object with ${Object.keys(value).slice(0, 4).join(', ') || 'no members'}` : String(value));

const isList = (value) => Array.isArray(value) || (ArrayBuffer.isView(value) && !(value instanceof DataView));
const isPoint = (value) => typeof value === 'object' && value !== null && !isList(value) && 'x' in value && 'y' in value;
const ofPoint = ({ x, y, z }) => (z === undefined ? [x, y] : [x, y, z]);

/** The numbers of a list, or of a list of lists, one after the other. `what` names them in messages. */
export function numbersOf(list, what = 'numbers') {
  if (ArrayBuffer.isView(list)) return list;
  const numbers = Array.isArray(list) ? list.flatMap((item) => (isList(item) ? Array.from(item) : [item])) : null;
  const bad = numbers === null ? -1 : numbers.findIndex((value) => typeof value !== 'number');
  if (numbers === null) throw new TypeError(`${what} are an array, not ${show(list)}`);
  if (bad >= 0) throw new TypeError(`${what}: ${show(numbers[bad])} is no number`);
  return numbers;
}

/** Points one after the other: a Float64Array as it is, or made from numbers, [[x, y], ...] or [{ x, y }, ...]. With
 *  `dim` each point must have this many numbers. */
export function flat(points, dim = 0) {
  const rows = isPoint(points) ? [ofPoint(points)]
    : Array.isArray(points) ? points.map((point) => (isPoint(point) ? ofPoint(point) : point)) : points;
  if (!isList(rows))
    throw new TypeError(`points are a Float64Array, or an array of numbers, of [x, y] or of { x, y }, not ${show(points)}`);
  const odd = dim === 0 || !Array.isArray(rows) ? undefined : rows.find((row) => isList(row) && row.length !== dim);
  if (odd !== undefined) throw new TypeError(`a point has ${odd.length} numbers, not ${dim}`);
  const numbers = rows instanceof Float64Array ? rows : Float64Array.from(numbersOf(rows, 'points'));
  if (dim > 0 && numbers.length % dim !== 0)
    throw new TypeError(`${numbers.length} numbers are no points of ${dim} each`);
  return numbers;
}

/** The vertices of an outline in the plane, each once. The list may repeat the first one at its end. */
export function ring(points) {
  const p = flat(points, 2), n = p.length;
  return n > 6 && p[0] === p[n - 2] && p[1] === p[n - 1] ? p.subarray(0, n - 2) : p;
}

/** An icc_mesh of simplices, for reading, or with room for writing. */
export const meshOf = (dim, vertices, cells) => ({
  dim, nVertices: vertices.length / dim, vertices, nCells: cells.length / (dim + 1), cells,
});

/** Vertex indices. */
export const indices = (list) => Uint32Array.from(numbersOf(list, 'indices'));
