// A shape: an outline, and what lies inside. Parts are { kind, points: [[x, y], ...], radius }, kind one
// of outline (the first, and only one), hole, line, point. Values are never changed: every edit gives a
// new shape, so that undoing is a matter of keeping the old one.

export const ORDER = ['outline', 'hole', 'line', 'point'];
export const CLOSED = { outline: true, hole: true, line: false, point: false, region: true };
export const LEAST = { outline: 3, hole: 3, line: 2, point: 1, region: 3 };

export const outlineOf = (points) => [{ kind: 'outline', points }];

/** Adds a part after those of its kind: the library numbers holes, then lines, then points. */
export function withPart(shape, part) {
  const rank = ORDER.indexOf(part.kind);
  const at = shape.findIndex((other) => ORDER.indexOf(other.kind) > rank);
  return at < 0 ? [...shape, part] : [...shape.slice(0, at), part, ...shape.slice(at)];
}

export const withoutPart = (shape, k) => shape.filter((_, i) => i !== k);

const replace = (shape, k, points) => shape.map((part, i) => (i === k ? { ...part, points } : part));

/** Puts vertex i of part k elsewhere. */
export const withVertex = (shape, k, i, point) =>
  replace(shape, k, shape[k].points.map((p, j) => (j === i ? point : p)));

/** Moves vertices of part k, all when `which` is null. */
export const moved = (shape, k, which, [dx, dy]) =>
  replace(shape, k, shape[k].points.map((p, j) =>
    (which === null || which.includes(j) ? [p[0] + dx, p[1] + dy] : p)));

export const movedAll = (shape, by) => shape.reduce((s, _, k) => moved(s, k, null, by), shape);

/** Adds a vertex on the edge after vertex i, at the share t of it. */
export function withCorner(shape, k, i, t = 0.5) {
  const { points } = shape[k];
  const a = points[i], b = points[(i + 1) % points.length];
  const corner = [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
  return replace(shape, k, [...points.slice(0, i + 1), corner, ...points.slice(i + 1)]);
}

/** Without vertex i of part k; without the part when too few are left; null if that is the outline. */
export function withoutVertex(shape, k, i) {
  const part = shape[k];
  if (part.points.length > LEAST[part.kind]) return replace(shape, k, part.points.filter((_, j) => j !== i));
  return part.kind === 'outline' ? null : withoutPart(shape, k);
}

export const countVertices = (shape) => shape.reduce((n, part) => n + part.points.length, 0);
export const flatOf = (points) => Float64Array.from(points.flat());

/** All vertices, flat, in the library's order. */
export const verticesOf = (shape) => Float64Array.from(shape.flatMap((part) => part.points.flat()));

/** As arguments of Domain.polygon(). */
export function domainArguments(shape) {
  const of = (kind) => shape.filter((part) => part.kind === kind);
  return [flatOf(shape[0].points), {
    holes: of('hole').map((p) => flatOf(p.points)), lines: of('line').map((p) => flatOf(p.points)),
    points: of('point').map((p) => flatOf(p.points)), radii: of('point').map((p) => p.radius ?? 0),
  }];
}

/** Edges of a part: pairs of numbers of vertices. */
export function edgesOf({ kind, points }) {
  const n = points.length;
  return Array.from({ length: CLOSED[kind] ? n : n - 1 }, (_, i) => [i, (i + 1) % n]);
}

export function boxOf(points) {
  const xs = points.map((p) => p[0]), ys = points.map((p) => p[1]);
  return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
}

export function centreOf(points) {
  const n = points.length;
  return [points.reduce((s, p) => s + p[0], 0) / n, points.reduce((s, p) => s + p[1], 0) / n];
}

/** The place on a polyline nearest to a point: { i, t, distance }. */
export function nearestEdge(part, [x, y]) {
  let best = { i: 0, t: 0, distance: Infinity };
  for (const [i, j] of edgesOf(part)) {
    const [a, b] = [part.points[i], part.points[j]];
    const dx = b[0] - a[0], dy = b[1] - a[1];
    const t = Math.max(0, Math.min(1, ((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy || 1)));
    const distance = Math.hypot(a[0] + t * dx - x, a[1] + t * dy - y);
    if (distance < best.distance) best = { i, t, distance };
  }
  return best;
}

export const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);
