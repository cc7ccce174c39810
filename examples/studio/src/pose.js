// Poses as the page keeps them: six numbers a handle, rows of (A | b), as icc_binding_pose() takes them.

export const atRest = (n) => Float64Array.from({ length: 6 * n }, (_, i) => (i % 6 === 0 || i % 6 === 4 ? 1 : 0));

/** Where a handle is in a pose. */
export function placeOf(transforms, handles, h) {
  const [x, y] = handles[h], t = 6 * h;
  return [0, 3].map((row) => transforms[t + row] * x + transforms[t + row + 1] * y + transforms[t + row + 2]);
}

/** What turns handles h and k together about the middle between them. */
export function turnPair([h, k], places, angle) {
  const c = [0, 1].map((a) => (places[0][a] + places[1][a]) / 2);
  return [h, k].map((handle, i) => {
    const [x, y] = [places[i][0] - c[0], places[i][1] - c[1]];
    const [u, v] = [x * Math.cos(angle) - y * Math.sin(angle), x * Math.sin(angle) + y * Math.cos(angle)];
    return { handle, angle, offset: [u - x, v - y] };
  });
}

/** The end of a line from a place on that is parallel to another, nearest to where it was to be. */
export function parallelEnd(other, from, to) {
  const [x, y] = [other.to[0] - other.from[0], other.to[1] - other.from[1]];
  const share = ((to[0] - from[0]) * x + (to[1] - from[1]) * y) / (x * x + y * y);
  return [from[0] + share * x, from[1] + share * y];
}

/** The place at rest of a posed point: in the triangle that it lies in; null outside. */
export function restOf({ vertices, images, triangles }, [x, y]) {
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [triangles[t], triangles[t + 1], triangles[t + 2]].map((i) => 2 * i);
    const bx = images[b] - images[a], by = images[b + 1] - images[a + 1], cx = images[c] - images[a], cy = images[c + 1] - images[a + 1];
    const det = bx * cy - by * cx, px = x - images[a], py = y - images[a + 1];
    const u = (px * cy - py * cx) / det, v = (bx * py - by * px) / det;
    if (u < 0 || v < 0 || u + v > 1) continue;
    return [0, 1].map((k) => vertices[a + k] + u * (vertices[b + k] - vertices[a + k]) + v * (vertices[c + k] - vertices[a + k]));
  }
  return null;
}
