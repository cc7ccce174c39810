// What is compared with: coordinates whose images are a fixed matrix times the cage's vertices. They
// give no certificate, and fold.

const NEAR = 1e-9; // of a coordinate: on a corner or an edge

/**
 * Mean value coordinates. Based on: M. Floater, Mean value coordinates, 2003; K. Hormann, M. Floater,
 * Mean value coordinates for arbitrary planar polygons, 2006. One row of n weights for each point.
 */
export function meanValue(cage, points) {
  const n = cage.length / 2, m = points.length / 2, weights = new Float64Array(n * m);
  for (let p = 0; p < m; ++p) meanValueRow(weights.subarray(p * n, p * n + n), cage, points[2 * p], points[2 * p + 1]);
  return weights;
}

function meanValueRow(row, cage, x, y) {
  const n = row.length;
  for (let i = 0; i < n; ++i) {
    const j = (i + 1) % n;
    const ax = cage[2 * i] - x, ay = cage[2 * i + 1] - y, bx = cage[2 * j] - x, by = cage[2 * j + 1] - y;
    const a = Math.sqrt(ax * ax + ay * ay), b = Math.sqrt(bx * bx + by * by);
    const cross = ax * by - ay * bx, dot = ax * bx + ay * by;
    if (a < NEAR || (Math.abs(cross) < NEAR * a * b && dot <= 0)) {
      row.fill(0);
      row[i] = b / (a + b);
      row[j] = a / (a + b);
      return;
    }
    if (b < NEAR || cross === 0) continue;
    const half = (a * b - dot) / cross;                  // the tangent of half the angle
    row[i] += half / a;
    row[j] += half / b;
  }
  let sum = 0;
  for (let i = 0; i < n; ++i) sum += row[i];
  for (let i = 0; i < n; ++i) row[i] /= sum;
}

const bend = (squared) => (squared > 0 ? 0.5 * squared * Math.log(squared) : 0);

/**
 * Thin-plate spline. Based on: F. Bookstein, Principal warps, 1989. Interpolates at the vertices only.
 */
export function thinPlate(cage, points) {
  const n = cage.length / 2, m = points.length / 2, size = n + 3;
  const at = (i) => [cage[2 * i], cage[2 * i + 1]];
  const matrix = Array.from({ length: size }, () => new Float64Array(size + n));
  for (let i = 0; i < n; ++i) {
    const [x, y] = at(i);
    for (let j = 0; j < n; ++j) matrix[i][j] = bend((x - at(j)[0]) ** 2 + (y - at(j)[1]) ** 2);
    [1, x, y].forEach((v, k) => { matrix[i][n + k] = v; matrix[n + k][i] = v; });
    matrix[i][size + i] = 1;
  }
  eliminate(matrix, size);
  const weights = new Float64Array(n * m), basis = new Float64Array(size);
  for (let p = 0; p < m; ++p) {
    const x = points[2 * p], y = points[2 * p + 1];
    for (let j = 0; j < n; ++j) basis[j] = bend((x - cage[2 * j]) ** 2 + (y - cage[2 * j + 1]) ** 2);
    basis.set([1, x, y], n);
    for (let k = 0; k < size; ++k)
      for (let i = 0, row = matrix[k], b = basis[k]; i < n; ++i) weights[p * n + i] += b * row[size + i];
  }
  return weights;
}

/** Gauss and Jordan with pivots: the right-hand sides, from column `size` on, become solutions. */
function eliminate(matrix, size) {
  for (let k = 0; k < size; ++k) {
    let pivot = k;
    for (let i = k + 1; i < size; ++i) if (Math.abs(matrix[i][k]) > Math.abs(matrix[pivot][k])) pivot = i;
    [matrix[k], matrix[pivot]] = [matrix[pivot], matrix[k]];
    const row = matrix[k], scale = 1 / row[k];
    for (let j = k; j < row.length; ++j) row[j] *= scale;
    for (let i = 0; i < size; ++i) {
      const factor = matrix[i][k];
      if (i === k || factor === 0) continue;
      for (let j = k; j < row.length; ++j) matrix[i][j] -= factor * row[j];
    }
  }
}

/** The images: weights times the vertices of the target. */
export function blend(weights, target) {
  const n = target.length / 2, m = weights.length / n, images = new Float64Array(2 * m);
  for (let p = 0, k = 0; p < m; ++p) {
    let x = 0, y = 0;
    for (let i = 0; i < n; ++i, ++k) { x += weights[k] * target[2 * i]; y += weights[k] * target[2 * i + 1]; }
    images[2 * p] = x;
    images[2 * p + 1] = y;
  }
  return images;
}
