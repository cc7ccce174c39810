// Triangles before and after: which fold, and how much each is stretched.

const MOST_VERTICES = 67108864;

/** Twice the signed area of triangle t of `triangles`. */
export function areaOf(points, triangles, t) {
  const a = 2 * triangles[t], b = 2 * triangles[t + 1], c = 2 * triangles[t + 2];
  return (points[b] - points[a]) * (points[c + 1] - points[a + 1])
    - (points[b + 1] - points[a + 1]) * (points[c] - points[a]);
}

/** Triangles whose image is turned over or has no area: their corners, for drawing. */
export function foldedOf(vertices, images, triangles) {
  const folded = [];
  for (let t = 0; t < triangles.length; t += 3) {
    const before = areaOf(vertices, triangles, t), after = areaOf(images, triangles, t);
    if (!(after * before > 0)) folded.push(triangles[t], triangles[t + 1], triangles[t + 2]);
  }
  return Uint32Array.from(folded);
}

/** The symmetric Dirichlet energy |J|^2 + |J^-1|^2 of each triangle: 4 for a motion, no upper bound. */
export function energiesOf(vertices, images, triangles) {
  const out = new Float32Array(triangles.length / 3);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [2 * triangles[t], 2 * triangles[t + 1], 2 * triangles[t + 2]];
    const e = vertices[b] - vertices[a], f = vertices[b + 1] - vertices[a + 1];
    const g = vertices[c] - vertices[a], h = vertices[c + 1] - vertices[a + 1];
    const area = e * h - f * g;
    const p = images[b] - images[a], q = images[b + 1] - images[a + 1];
    const r = images[c] - images[a], s = images[c + 1] - images[a + 1];
    const j = [(p * h - r * f) / area, (r * e - p * g) / area, (q * h - s * f) / area, (s * e - q * g) / area];
    const norm = j[0] ** 2 + j[1] ** 2 + j[2] ** 2 + j[3] ** 2, det = j[0] * j[3] - j[1] * j[2];
    out[t / 3] = norm * (1 + 1 / (det * det));
  }
  return out;
}

/** Each edge once, as pairs of vertices. */
export function linesOf(triangles) {
  const lines = [];
  const seen = new Set();
  for (let t = 0; t < triangles.length; t += 3) {
    for (let k = 0; k < 3; ++k) {
      const a = triangles[t + k], b = triangles[t + (k + 1) % 3];
      const key = a < b ? a * MOST_VERTICES + b : b * MOST_VERTICES + a;
      if (seen.has(key)) continue;
      seen.add(key);
      lines.push(a, b);
    }
  }
  return Uint32Array.from(lines);
}

/** The rings around the images: edges of one triangle only, in their order. The first is not always the outer one. */
export function rimsOf({ images, triangles }) {
  const edges = new Set(), next = new Map();
  for (let t = 0; t < triangles.length; t += 3)
    for (let k = 0; k < 3; ++k) edges.add(triangles[t + k] * MOST_VERTICES + triangles[t + ((k + 1) % 3)]);
  for (const key of edges) {
    const a = Math.floor(key / MOST_VERTICES), b = key % MOST_VERTICES;
    if (!edges.has(b * MOST_VERTICES + a)) next.set(a, b);
  }
  const rims = [];
  while (next.size > 0) {
    const rim = [];
    for (let [at] = next.keys(), to; (to = next.get(at)) !== undefined; at = to) {
      rim.push([images[2 * at], images[2 * at + 1]]);
      next.delete(at);
    }
    rims.push(rim);
  }
  return rims;
}

/** The outline of images without holes. */
export const rimOf = (mesh) => rimsOf(mesh)[0];
