// The figure in a picture with a transparent ground: the largest outline of what is not transparent, and its holes.
const SEEN = 16, CLOSE = 0.75; // alpha from which a pixel belongs to the figure; pixels between an outline and its simplification
const STEPS = [[1, 0], [0, 1], [-1, 0], [0, -1]];

/** Rings along the sides of opaque pixels, through the middles of the sides. What is opaque lies to the right. */
function ringsOf({ data, width: w, height: h }) {
  const isIn = (x, y) => x >= 0 && y >= 0 && x < w && y < h && data[4 * (y * w + x) + 3] >= SEEN;
  const seen = new Uint8Array(w * h), rings = [];
  for (let y = 0; y < h; ++y)
    for (let x = 0; x < w; ++x) {
      if (seen[y * w + x] || !isIn(x, y) || isIn(x, y - 1)) continue;
      const ring = [];
      let [u, v, k] = [x, y, 0];      // a corner of pixels, and the direction in which the ring goes on
      do {
        const [dx, dy] = STEPS[k];
        if (k === 0) seen[v * w + u] = 1;
        ring.push([u + dx / 2, v + dy / 2]);
        [u, v] = [u + dx, v + dy];
        const ahead = (side) => isIn(u + (dx - 1 - side * dy) / 2, v + (dy - 1 + side * dx) / 2);
        k = (k + (!ahead(1) ? 1 : ahead(-1) ? 3 : 0)) % 4;
      } while (u !== x || v !== y || k !== 0);
      rings.push(ring);
    }
  return rings;
}

/** Vertices from a to b that a line needs to stay close (Douglas and Peucker 1973); not b itself. */
function simplified(ring, a, b) {
  const [p, q] = [ring[a], ring[b % ring.length]], [dx, dy] = [q[0] - p[0], q[1] - p[1]], length = Math.hypot(dx, dy);
  let [most, at] = [CLOSE, 0];
  for (let i = a + 1; i < b; ++i) {
    const [x, y] = [ring[i][0] - p[0], ring[i][1] - p[1]], d = length > 0 ? Math.abs(x * dy - y * dx) / length : Math.hypot(x, y);
    if (d > most) [most, at] = [d, i];
  }
  return at ? [...simplified(ring, a, at), ...simplified(ring, at, b)] : [p];
}

const areaOf = (ring) => ring.reduce((sum, [x, y], i) => {
  const [u, v] = ring[(i + 1) % ring.length];
  return sum + (x * v - u * y) / 2;
}, 0);

const isInside = (ring, [x, y]) => ring.reduce((odd, [a, b], i) => {
  const [c, d] = ring[(i + 1) % ring.length];
  return (b > y) !== (d > y) && x < a + (c - a) * (y - b) / (d - b) ? !odd : odd;
}, false);

/** The figure as a shape, or null if nothing is transparent. */
export function cutoutOf(image) {
  const { width, height } = image, g = Object.assign(document.createElement('canvas'), { width, height }).getContext('2d');
  g.drawImage(image, 0, 0);
  const all = ringsOf(g.getImageData(0, 0, width, height)), outer = all.reduce((best, r) => (areaOf(r) > areaOf(best) ? r : best), []);
  if (outer.length === 0 || outer.length === 2 * (width + height)) return null;
  const holes = all.filter((ring) => areaOf(ring) < 0 && isInside(outer, ring[0]));
  return [outer, ...holes].map((ring, i) => ({ kind: i ? 'hole' : 'outline', points: simplified(ring, 0, ring.length) }))
    .filter(({ points }) => points.length > 2);
}
