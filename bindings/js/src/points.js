// Checks the caller's points and numbers. A value that is not a number is refused.

const show = (value) => (typeof value === 'string' ? `'${value}'` : typeof value === 'object' && value !== null
  ? `an object with ${Object.keys(value).slice(0, 4).join(', ') || 'no members'}` : String(value));

const isList = (value) => Array.isArray(value) || (ArrayBuffer.isView(value) && !(value instanceof DataView));
const isPoint = (value) => typeof value === 'object' && value !== null && !isList(value) && 'x' in value && 'y' in value;
const ofPoint = ({ x, y, z }) => (z === undefined ? [x, y] : [x, y, z]);

/** The numbers of a list, or of a list of lists, one after the other. `what` names them in messages. */
export function numbersOf(list, what = 'numbers') {
  if (ArrayBuffer.isView(list) && isList(list)) return list;
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
  if (odd !== undefined && isList(odd[0]))
    throw new TypeError('these are rings, not points: of a polygon of GeoJSON pass coordinates[0], and the others as holes');
  if (odd !== undefined) throw new TypeError(`a point has ${odd.length} numbers, not ${dim}`);
  const numbers = rows instanceof Float64Array ? rows : Float64Array.from(numbersOf(rows, 'points'));
  if (dim > 0 && numbers.length % dim !== 0)
    throw new TypeError(`${numbers.length} numbers are no points of ${dim} each`);
  return numbers;
}

/** One point: exactly `dim` numbers. */
export function onePoint(point, dim) {
  const p = flat(point, dim);
  if (p.length !== dim) throw new TypeError(`one point has ${dim} numbers, not ${p.length}`);
  return p;
}

/** Options whose `member` is a point, of which C reads `dim` numbers. */
export const withPoint = (options, member, dim) =>
  (options?.[member] ? { ...options, [member]: onePoint(options[member], dim) } : options);

/** A list that a C function reads without a count of its own. It must have exactly n entries. */
export function exactly(list, n, what) {
  if (!isList(list)) throw new TypeError(`${what} must be an array of ${n} numbers, not ${show(list)}`);
  if (list.length !== n) throw new TypeError(`${what} has ${list.length} numbers, but ${n} are needed`);
  return list;
}

/** A whole number that is at least `least`. */
export function whole(value, least, what) {
  if (!Number.isSafeInteger(value) || value < least)
    throw new TypeError(`${what} is ${show(value)}, but must be a whole number of at least ${least}`);
  return value;
}

/** The numbers of cells or vertices along the axes, and their product. */
export function sidesOf(shape) {
  if (!isList(shape)) throw new TypeError(`shape is an array of sizes, not ${show(shape)}`);
  const sides = Uint32Array.from(shape, (side, i) => whole(side, 1, `shape[${i}]`));
  return { sides, n: shape.reduce((product, side) => product * side, 1) };
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

/** Vertex indices, in rows of `width`. */
export function indices(list, width = 1) {
  const numbers = Uint32Array.from(numbersOf(list, 'indices'), (value) => whole(value, 0, 'an index'));
  if (numbers.length % width !== 0) throw new TypeError(`${numbers.length} indices are no rows of ${width} each`);
  return numbers;
}
