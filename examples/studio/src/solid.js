// A bar of triangles in space, what bends it, and what of a solid a plane leaves.

const LENGTH = 3, SIDE = 0.5;
const ALONG = 14, ACROSS = 3;

/** The surface of a bar as a grid of squares cut in two: { points, facets }. */
export function bar() {
  const n = [ALONG, ACROSS, ACROSS], index = new Map(), points = [], facets = [];
  const vertex = (p) => {
    const key = p.join();
    if (!index.has(key)) {
      index.set(key, points.length / 3);
      points.push((p[0] / n[0] - 0.5) * LENGTH, (p[1] / n[1] - 0.5) * 2 * SIDE, (p[2] / n[2] - 0.5) * 2 * SIDE);
    }
    return index.get(key);
  };
  for (let axis = 0; axis < 3; ++axis)
    for (const end of [0, n[axis]]) {
      const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
      for (let i = 0; i < n[u]; ++i)
        for (let j = 0; j < n[v]; ++j) {
          const at = (di, dj) => { const p = []; p[axis] = end; p[u] = i + di; p[v] = j + dj; return vertex(p); };
          const [a, b, c, d] = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
          facets.push(...(end ? [a, b, c, a, c, d] : [a, c, b, a, d, c]));
        }
    }
  return { points: Float64Array.from(points), facets: Uint32Array.from(facets) };
}

/** The bar bent to an arc of `bend` radians, twisted by `twist` from end to end, drawn thin in the middle. */
export function deform(points, { bend, twist, waist }) {
  const out = new Float64Array(points.length);
  for (let i = 0; i < points.length; i += 3) {
    const s = points[i] / LENGTH, a = twist * s, thin = 1 - waist * Math.exp(-18 * s * s);
    const y = (points[i + 1] * Math.cos(a) - points[i + 2] * Math.sin(a)) * thin;
    const z = (points[i + 1] * Math.sin(a) + points[i + 2] * Math.cos(a)) * thin;
    const r = LENGTH / (bend || 1e-9), t = bend * s;
    const flat = Math.abs(bend) < 1e-3;
    out[i] = flat ? points[i] : (r - y) * Math.sin(t);
    out[i + 1] = flat ? y : r - (r - y) * Math.cos(t);
    out[i + 2] = z;
  }
  return out;
}

const SIDES = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];
const EDGES = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
const between = (a, b, s) => a.map((v, k) => v + s * (b[k] - v));

/** Faces of one tetrahedron only: the surface. */
function surfaceOf(simplices) {
  const faces = new Map();
  for (let t = 0; t < simplices.length; t += 4)
    for (const side of SIDES) {
      const face = side.map((k) => simplices[t + k]), key = [...face].sort((a, b) => a - b).join();
      if (faces.has(key)) faces.set(key, null); else faces.set(key, { face, cell: t / 4 });
    }
  return [...faces.values()].filter(Boolean);
}

/** The part of a polygon where the height is not above 0; points are arrays that end with it. */
function clip(polygon) {
  return polygon.flatMap((p, i) => {
    const q = polygon[(i + 1) % polygon.length], [u, v] = [p.at(-1), q.at(-1)];
    const crossing = (u > 0) !== (v > 0) ? [between(p, q, u / (u - v))] : [];
    return u > 0 ? crossing : [p, ...crossing];
  });
}

/** Where a plane cuts a tetrahedron: a triangle, or a quadrangle in the order of its ring. */
function section(corners) {
  const cuts = EDGES.filter(([i, j]) => (corners[i].at(-1) > 0) !== (corners[j].at(-1) > 0));
  const at = ([i, j]) => between(corners[i], corners[j], corners[i].at(-1) / (corners[i].at(-1) - corners[j].at(-1)));
  if (cuts.length !== 4) return cuts.map(at);
  const [first, ...others] = cuts, shares = (e, f) => e.some((v) => f.includes(v));
  const opposite = others.find((e) => !shares(e, first));
  const [second, fourth] = others.filter((e) => e !== opposite);
  return [first, second, opposite, fourth].map(at);
}

/**
 * What is left of a solid below a plane of the source, and where the map takes it: the map is linear in each
 * tetrahedron, so that the cut is exact on both sides. Arrays for Renderer3, and the tetrahedron of
 * each triangle: { before, after, corners, opened, cells }.
 */
export function sliced({ vertices, images, simplices }, axis, cut) {
  const out = { before: [], after: [], corners: [], opened: [], cells: [] };
  const corner = (v) => [...vertices.subarray(3 * v, 3 * v + 3), ...images.subarray(3 * v, 3 * v + 3), vertices[3 * v + axis] - cut];
  const add = (polygon, opened, cell) => {
    for (let i = 1; i + 1 < polygon.length; ++i) {
      const three = [polygon[0], polygon[i], polygon[i + 1]];
      const hidden = [0, i + 2 < polygon.length ? 1 : 0, i > 1 ? 1 : 0];       // edges that only cut the polygon up
      three.forEach((p, k) => {
        out.before.push(p[0], p[1], p[2]);
        out.after.push(p[3], p[4], p[5]);
        out.corners.push(...hidden.map((h, e) => h + (e === k ? 1 : 0)));
      });
      out.opened.push(opened);
      out.cells.push(cell);
    }
  };
  for (const { face, cell } of surfaceOf(simplices)) add(clip(face.map(corner)), false, cell);
  for (let t = 0; t < simplices.length; t += 4) {
    const corners = [0, 1, 2, 3].map((k) => corner(simplices[t + k])), above = corners.filter((p) => p.at(-1) > 0).length;
    if (above > 0 && above < 4) add(section(corners), true, t / 4);
  }
  return out;
}

/** Tetrahedra whose image is not positive, counted. */
export function turnedOver({ images, simplices }) {
  let count = 0;
  for (let t = 0; t < simplices.length; t += 4) {
    const [a, b, c, d] = [0, 1, 2, 3].map((k) => 3 * simplices[t + k]);
    const e = [b, c, d].map((p) => [images[p] - images[a], images[p + 1] - images[a + 1], images[p + 2] - images[a + 2]]);
    const det = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0])
      + e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    count += det > 0 ? 0 : 1;
  }
  return count;
}
