// Drawings of the papers' steps on a canvas.

const NONE = 0xffffffff;
const RAMP = [[33, 51, 97], [36, 140, 153], [224, 204, 122], [214, 64, 56]];

/** A colour for 0 to 1, as the shader has it. */
export function ramp(t) {
  const x = Math.min(0.9999, Math.max(0, t)) * 3, k = Math.floor(x), s = x - k;
  return `rgb(${RAMP[k].map((v, i) => Math.round(v + s * (RAMP[k + 1][i] - v))).join()})`;
}

/** How many rounds the fire burns before it reaches each vertex: -1 outside (Algorithm 1). */
export function grassfire({ shape: [w, h] }, inside) {
  const rounds = new Int32Array(w * h).fill(-1);
  const near = (v) => [v % w > 0 ? v - 1 : -1, v % w < w - 1 ? v + 1 : -1, v - w, v + w < w * h ? v + w : -1];
  let front = [];
  for (let v = 0; v < w * h; ++v)
    if (inside[v] && near(v).some((u) => u < 0 || !inside[u])) { rounds[v] = 0; front.push(v); }
  for (let round = 1; front.length > 0; ++round) {
    const next = [];
    for (const v of front)
      for (const u of near(v)) if (u >= 0 && inside[u] && rounds[u] < 0) { rounds[u] = round; next.push(u); }
    front = next;
  }
  return rounds;
}

/** Values from 0 to 1 that order the function's, whose range may be that of logarithms. */
export function levels(values, inside) {
  const all = [...values].filter((v, i) => inside[i] && Number.isFinite(v));
  const least = all.reduce((a, b) => Math.min(a, b), Infinity), most = all.reduce((a, b) => Math.max(a, b), -Infinity);
  const logs = least > 0, low = logs ? Math.log(least) : least, high = logs ? Math.log(most) : most;
  return Float64Array.from(values, (v, i) => (inside[i] && Number.isFinite(v) ? ((logs ? Math.log(v) : v) - low) / (high - low || 1) : -0.04));
}

/** Pieces of the level lines of a function that is linear on the two triangles of each square. */
export function levelLines({ shape: [w, h] }, height, n) {
  const pieces = [];
  const cut = (tri, level) => {
    const ends = [];
    for (let k = 0; k < 3; ++k) {
      const [a, b] = [tri[k], tri[(k + 1) % 3]], u = height[a] - level, v = height[b] - level;
      if ((u < 0) === (v < 0)) continue;
      const s = u / (u - v);
      ends.push([(a % w) + s * ((b % w) - (a % w)), Math.floor(a / w) + s * (Math.floor(b / w) - Math.floor(a / w))]);
    }
    if (ends.length === 2) pieces.push(ends);
  };
  for (let y = 0; y + 1 < h; ++y)
    for (let x = 0; x + 1 < w; ++x) {
      const v = x + w * y;
      for (const tri of [[v, v + 1, v + w + 1], [v, v + w + 1, v + w]])
        if (tri.every((u) => height[u] >= 0)) for (let level = 0; level < n; ++level) cut(tri, (level + 0.5) / n);
    }
  return pieces;
}

/** A canvas whose units are those of the plane; gives them, and what a pixel is. */
function begin(panel, image, strength) {
  const { canvas, box } = panel, ratio = Math.min(2, globalThis.devicePixelRatio || 1), g = canvas.getContext('2d');
  canvas.width = Math.max(1, canvas.clientWidth * ratio);
  canvas.height = Math.max(1, canvas.clientHeight * ratio);
  const scale = Math.min(canvas.width / box[2], canvas.height / box[3]);
  g.setTransform(scale, 0, 0, scale, canvas.width / 2 - scale * (box[0] + box[2] / 2), canvas.height / 2 - scale * (box[1] + box[3] / 2));
  g.globalAlpha = strength;
  g.drawImage(image, 0, 0);
  g.globalAlpha = 1;
  return [g, ratio / scale];
}

const trail = (g, points) => {
  g.beginPath();
  for (let i = 0; i < points.length; i += 2) g.lineTo(points[i], points[i + 1]);
  g.stroke();
};

const STEPS = {
  grid(g, u, d, at) {
    for (let v = 0; v < d.inside.length; ++v) {
      g.fillStyle = d.inside[v] ? '#1c5fa8' : 'rgb(120 130 140 / .35)';
      const [x, y] = at(v), r = d.grid.spacing * (d.inside[v] ? 0.16 : 0.07);
      g.fillRect(x - r, y - r, 2 * r, 2 * r);
    }
  },
  fire(g, u, d, at) { cells(g, d, at, (v) => (d.burnt[v] < 0 ? null : ramp(d.burnt[v] / Math.max(1, d.rounds)))); },
  tree(g, u, d, at) {
    const deepest = d.generations.reduce((a, b) => Math.max(a, b), 1);
    g.lineWidth = Math.max(1.2 * u, d.grid.spacing * 0.14);
    for (let v = 0; v < d.inside.length; ++v) {
      if (!d.inside[v] || d.parents[v] === NONE) continue;
      g.strokeStyle = ramp(1 - d.generations[v] / deepest);
      trail(g, [...at(v), ...at(d.parents[v])]);
    }
  },
  function(g, u, d, at) { cells(g, d, at, (v) => (d.inside[v] ? ramp(d.height[v]) : null)); },
  levels(g, u, d) {
    const [x, y] = d.grid.origin, s = d.grid.spacing;
    g.lineWidth = 1.2 * u;
    g.strokeStyle = '#1c5fa8';
    for (const [a, b] of d.lines) trail(g, [x + s * a[0], y + s * a[1], x + s * b[0], y + s * b[1]]);
  },
  curves(g, u, d) {
    g.globalAlpha = 0.35;
    STEPS.levels(g, 0.7 * u, d);
    g.globalAlpha = 1;
    g.lineWidth = 1.3 * u;
    g.strokeStyle = '#b04a00';
    for (const curve of d.curves) trail(g, curve);
  },
  walk(g, u, d, at) {
    g.globalAlpha = 0.35;
    STEPS.levels(g, 0.7 * u, d);
    g.globalAlpha = 1;
    g.lineWidth = 1.5 * u;
    for (let k = 0; k < d.kinds.length; ++k) {
      g.strokeStyle = d.kinds[k] === 1 ? '#d64038' : '#17734f';
      trail(g, [...at(d.edges[2 * k]), ...at(d.edges[2 * k + 1])]);
    }
  },
};

function cells(g, d, at, colour) {
  const s = d.grid.spacing;
  for (let v = 0; v < d.inside.length; ++v) {
    const c = colour(v);
    if (c === null) continue;
    g.fillStyle = c;
    const [x, y] = at(v);
    g.fillRect(x - s / 2, y - s / 2, s * 1.03, s * 1.03);
  }
}

/** Draws a step on a panel, and the curve through a point. */
export function drawStep(panel, image, step, data, curve, point) {
  const [g, u] = begin(panel, image, step === null ? 0.9 : 0.22);
  g.lineCap = g.lineJoin = 'round';
  const at = (v) => [0, 1].map((a) => data.grid.origin[a] + data.grid.spacing * (a === 0 ? v % data.grid.shape[0] : Math.floor(v / data.grid.shape[0])));
  if (step !== null) {
    STEPS[step](g, u, data, at);
    ring(g, at(data.maximum), 6 * u, '#fff', '#b3261e', 2.5 * u);
  }
  if (curve?.length) {
    g.lineWidth = 5 * u; g.strokeStyle = '#fff'; trail(g, curve);
    g.lineWidth = 2.4 * u; g.strokeStyle = '#c77700'; trail(g, curve);
  }
  if (point) ring(g, point, 5 * u, '#1ec28b', '#fff', 1.6 * u);
}

function ring(g, [x, y], r, fill, stroke, width) {
  g.beginPath();
  g.arc(x, y, r, 0, 2 * Math.PI);
  g.fillStyle = fill;
  g.fill();
  g.lineWidth = width;
  g.strokeStyle = stroke;
  g.stroke();
}
