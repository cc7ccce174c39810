// A bar of triangles in space, what bends it, and what of a solid is seen: faces between what a plane
// leaves and what it takes away.

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

/**
 * The faces of the tetrahedra whose centre has less than `cut` along an axis of the source, that no two of
 * these share: as triangles, with 1 for those that the plane has opened.
 */
export function visible({ vertices, simplices }, axis, cut) {
  const faces = new Map();
  let kept = 0;
  for (let t = 0; t < simplices.length; t += 4) {
    const v = simplices.subarray(t, t + 4);
    const below = (vertices[3 * v[0] + axis] + vertices[3 * v[1] + axis] + vertices[3 * v[2] + axis] + vertices[3 * v[3] + axis]) / 4 <= cut;
    kept += below ? 1 : 0;
    for (const side of SIDES) {
      const face = side.map((k) => v[k]), key = [...face].sort((a, b) => a - b).join();
      const found = faces.get(key);
      if (found) { found.n += below ? 1 : 0; ++found.all; if (below) found.face = face; } else faces.set(key, { face, n: below ? 1 : 0, all: 1 });
    }
  }
  const shown = [...faces.values()].filter(({ n }) => n === 1);
  return { triangles: Uint32Array.from(shown.flatMap(({ face }) => face)), opened: shown.map(({ all }) => all === 2), kept };
}

/** Six times the volume of each tetrahedron that is not positive, counted. */
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
