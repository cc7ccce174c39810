// The page of `libicc plot OUT.html`: both shapes, the way between, a cut, and what stretches.
const $ = (id) => document.getElementById(id);
const bytesOf = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
const data = JSON.parse($('data').textContent), { dim } = data;
const map = { before: new Float32Array(bytesOf(data.before)), after: new Float32Array(bytesOf(data.after)),
  cells: new Uint32Array(bytesOf(data.cells)) };
const TINTS = [[0.85, 0.42, 0.45], [0.36, 0.62, 0.85], [0.50, 0.72, 0.42], [0.70, 0.52, 0.82], [0.90, 0.65, 0.30], [0.35, 0.72, 0.70]];
const parts = data.parts.map((part, i) => ({ ...part, facets: new Uint32Array(bytesOf(part.facets)), tint: TINTS[i % TINTS.length] }));
const look = { turn: 0.6, tilt: -0.35, distance: 2.7 }, zoom = { scale: 1 };

/** The greatest and least factor by which a cell of the map stretches lengths, from its edges before and after. */
function stretchOf(cell) {
  const edges = (at) => Array.from({ length: dim }, (_, j) => Array.from({ length: dim }, (_, k) =>
    at[dim * map.cells[cell * (dim + 1) + j + 1] + k] - at[dim * map.cells[cell * (dim + 1)] + k]));
  const b = edges(map.before), a = edges(map.after), m = b.map((row, i) => [...row, ...a[i]]);
  for (let c = 0; c < dim; ++c) {                    // solves b j = a
    let p = c;
    for (let r = c; r < dim; ++r) if (Math.abs(m[r][c]) > Math.abs(m[p][c])) p = r;
    [m[c], m[p]] = [m[p], m[c]];
    for (let r = 0; r < dim; ++r) if (r !== c) { const f = m[r][c] / m[c][c]; m[r] = m[r].map((v, k) => v - f * m[c][k]); }
  }
  const j = m.map((row, i) => row.slice(dim).map((v) => v / row[i]));
  const g = j.map((p) => j.map((q) => p.reduce((s, v, k) => s + v * q[k], 0)));
  for (let sweep = 0; sweep < 8; ++sweep)            // Jacobi's rotations: eigenvalues on the diagonal
    for (let p = 0; p < dim; ++p) for (let q = p + 1; q < dim; ++q) {
      if (!g[p][q]) continue;
      const t = 0.5 * Math.atan2(2 * g[p][q], g[q][q] - g[p][p]), [c, s] = [Math.cos(t), Math.sin(t)];
      for (let k = 0; k < dim; ++k) [g[k][p], g[k][q]] = [c * g[k][p] - s * g[k][q], s * g[k][p] + c * g[k][q]];
      for (let k = 0; k < dim; ++k) [g[p][k], g[q][k]] = [c * g[p][k] - s * g[q][k], s * g[p][k] + c * g[q][k]];
    }
  const all = g.map((row, k) => Math.sqrt(Math.max(row[k], 1e-12)));
  return Math.max(...all, ...all.map((v) => 1 / v));
}

const stretches = Float64Array.from({ length: map.cells.length / (dim + 1) }, (_, i) => stretchOf(i));
const most = Math.max(1.5, [...stretches].sort((a, b) => a - b)[Math.floor(0.98 * (stretches.length - 1))] || 1.5);
function colourOf(stretch) {
  const stops = [[0.91, 0.925, 0.937], [0.88, 0.80, 0.48], [0.84, 0.25, 0.22]];
  const t = 2 * Math.max(0, Math.min(1, Math.log(stretch) / Math.log(most))), i = t < 1 ? 0 : 1;
  return stops[i].map((v, k) => v + (t - i) * (stops[i + 1][k] - v));
}

const halfway = (share) => map.before.map((v, i) => v + share * (map.after[i] - v));

function boxOf(...arrays) {
  const low = Array(dim).fill(Infinity), high = Array(dim).fill(-Infinity);
  for (const at of arrays) for (let i = 0; i < at.length; ++i) {
    low[i % dim] = Math.min(low[i % dim], at[i]);
    high[i % dim] = Math.max(high[i % dim], at[i]);
  }
  return { low, high, middle: low.map((v, k) => (v + high[k]) / 2), size: Math.hypot(...low.map((v, k) => high[k] - v)) };
}

const canvases = [$('before'), $('after')];
const share = () => Number($('share').value);
let draw = () => {};

/** Bodies in space by WebGL: what the plane leaves of the source, and where it goes. */
function solidView() {
  const [source, target] = [boxOf(map.before), boxOf(map.after)], scale = 2.6 / Math.max(source.size, target.size);
  const renderers = canvases.map((canvas) => new Renderer3(canvas));
  const extents = source.low.map((v, k) => source.high[k] - v);
  $('up').value = extents[2] > extents[1] ? '2' : '1';
  $('axis').value = $('up').value === '2' ? '1' : '2';
  if ($('up').value === '2') look.turn += Math.PI;     // the cut faces the eye
  let shell = null;
  const place = (at, { middle }) => {
    const out = new Float32Array(at.length), z = $('up').value === '2';
    for (let i = 0; i < at.length; i += 3) {
      const [x, y, h] = [0, 1, 2].map((k) => scale * (at[i + k] - middle[k]));
      out.set(z ? [x, h, -y] : [x, y, h], i);
    }
    return out;
  };
  const cut = () => {
    const axis = Number($('axis').value), at = axis < 0 ? 0 : source.low[axis] + Number($('cut').value) * extents[axis];
    shell = sliced({ vertices: map.before, images: map.after, simplices: map.cells }, Math.max(0, axis), axis < 0 ? Infinity : at);
    const tones = shell.tones = [], plain = [0.62, 0.71, 0.79];
    shell.opened.forEach((opened, i) => {
      const rgb = $('stretch').checked ? colourOf(stretches[shell.cells[i]]) : opened ? [0.93, 0.72, 0.45] : plain;
      for (let k = 0; k < 3; ++k) tones.push(...rgb, opened ? 0.5 : 0.18);
    });
    for (const part of parts)
      for (let t = 0; t < part.facets.length; t += 3) {
        part.facets.subarray(t, t + 3).forEach((v, k) => {
          shell.before.push(...map.before.subarray(3 * v, 3 * v + 3));
          shell.after.push(...map.after.subarray(3 * v, 3 * v + 3));
          shell.corners.push(...[0, 1, 2].map((e) => (e === k ? 1 : 0)));
          tones.push(...part.tint, 0.12);
        });
      }
  };
  const fill = () => {
    const s = share(), corners = shell.corners, tones = Float32Array.from(shell.tones);
    const middle = source.middle.map((v, k) => v + s * (target.middle[k] - v));
    renderers[0].triangles(place(shell.before, source), corners, tones);
    renderers[1].triangles(place(shell.before.map((v, i) => v + s * (shell.after[i] - v)), { middle }), corners, tones);
  };
  draw = () => renderers.forEach((r) => r.draw(look));
  for (const id of ['cut', 'axis', 'stretch', 'up']) $(id).addEventListener('input', () => { cut(); fill(); draw(); });
  $('share').addEventListener('input', () => { fill(); draw(); });
  cut();
  fill();
}

/** The plane on two canvases: triangles by their stretch, and a grid of the source that the map bends. */
function flatView() {
  const boxes = [boxOf(map.before), boxOf(map.after)], step = Math.max(...boxes[0].low.map((v, k) => boxes[0].high[k] - v)) / 24;
  const paint = (canvas, at, box) => {
    const ratio = globalThis.devicePixelRatio || 1, [w, h] = [canvas.clientWidth * ratio, canvas.clientHeight * ratio];
    [canvas.width, canvas.height] = [w, h];
    const g = canvas.getContext('2d'), ink = getComputedStyle(document.body).color;
    const scale = zoom.scale * 0.92 * Math.min(w / (box.high[0] - box.low[0]), h / (box.high[1] - box.low[1]));
    const up = data.y_down ? 1 : -1, to = (p) => [w / 2 + scale * (p[0] - box.middle[0]), h / 2 + up * scale * (p[1] - box.middle[1])];
    const lines = new Path2D();
    for (let t = 0; t < map.cells.length; t += 3) {
      const v = [...map.cells.subarray(t, t + 3)], from = v.map((k) => [map.before[2 * k], map.before[2 * k + 1]]);
      const now = v.map((k) => to([at[2 * k], at[2 * k + 1]]));
      g.beginPath();
      now.forEach((p, k) => (k ? g.lineTo(...p) : g.moveTo(...p)));
      g.closePath();
      g.fillStyle = g.strokeStyle = `rgb(${($('stretch').checked ? colourOf(stretches[t / 3]) : [0.86, 0.9, 0.94]).map((c) => Math.round(255 * c))})`;
      g.fill();
      g.stroke();
      if (!$('lines').checked) continue;
      for (let axis = 0; axis < 2; ++axis) {
        const x = from.map((p) => p[axis] / step);
        for (let i = Math.ceil(Math.min(...x)); i <= Math.max(...x); ++i) {
          const ends = [[0, 1], [1, 2], [2, 0]].filter(([p, q]) => (x[p] < i) !== (x[q] < i)).map(([p, q]) => {
            const s = (i - x[p]) / (x[q] - x[p]);
            return [now[p][0] + s * (now[q][0] - now[p][0]), now[p][1] + s * (now[q][1] - now[p][1])];
          });
          if (ends.length === 2) { lines.moveTo(...ends[0]); lines.lineTo(...ends[1]); }
        }
      }
    }
    g.lineWidth = 0.8 * ratio;
    g.strokeStyle = 'rgb(40 66 110 / .75)';
    g.stroke(lines);
    const sides = new Map(), rim = new Path2D();
    for (let t = 0; t < map.cells.length; t += 3)
      for (let k = 0; k < 3; ++k) {
        const [p, q] = [map.cells[t + k], map.cells[t + (k + 1) % 3]], key = p < q ? `${p},${q}` : `${q},${p}`;
        sides.set(key, sides.has(key) ? null : [p, q]);
      }
    for (const side of sides.values())
      if (side) { rim.moveTo(...to([at[2 * side[0]], at[2 * side[0] + 1]])); rim.lineTo(...to([at[2 * side[1]], at[2 * side[1] + 1]])); }
    g.lineWidth = 1.8 * ratio;
    g.strokeStyle = ink;
    g.stroke(rim);
  };
  draw = () => { paint(canvases[0], map.before, boxes[0]); paint(canvases[1], halfway(share()), boxes[1]); };
  for (const id of ['share', 'stretch', 'lines']) $(id).addEventListener('input', () => draw());
}

function listen(canvas) {
  const held = new Map();
  const turn = (dx, dy) => { look.turn -= dx; look.tilt = Math.max(-1.5, Math.min(1.5, look.tilt + dy)); draw(); };
  const nearer = (by) => { look.distance = Math.max(1.2, Math.min(20, look.distance / by)); zoom.scale *= by; draw(); };
  canvas.addEventListener('pointerdown', (e) => { canvas.setPointerCapture(e.pointerId); held.set(e.pointerId, [e.clientX, e.clientY]); });
  for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, (e) => held.delete(e.pointerId));
  canvas.addEventListener('pointermove', (e) => {
    const old = held.get(e.pointerId);
    if (!old) return;
    const spread = () => { const [p, q] = [...held.values()]; return Math.hypot(p[0] - q[0], p[1] - q[1]); };
    const was = held.size === 2 ? spread() : 0;
    held.set(e.pointerId, [e.clientX, e.clientY]);
    if (held.size === 1) turn((e.clientX - old[0]) * 0.008, (e.clientY - old[1]) * 0.008);
    else if (was > 0) nearer(spread() / was);
  });
  canvas.addEventListener('wheel', (e) => { e.preventDefault(); nearer(e.deltaY > 0 ? 0.93 : 1.08); }, { passive: false });
  canvas.addEventListener('keydown', (e) => {
    const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[e.key];
    if (by) turn(by[0] * 0.12, by[1] * 0.12);
    else if (e.key === '+' || e.key === '-') nearer(e.key === '+' ? 1.1 : 0.9);
    else return;
    e.preventDefault();
  });
}

document.body.className = dim === 3 ? 'solid' : 'flat';
const base = (name) => name.split(/[\\/]/).pop();
$('names').textContent = `${base(data.source)} → ${base(data.target)}`;
$('badge').textContent = data.certified ? '✓ certified one-to-one' : '✗ not certified';
$('badge').className = data.certified ? 'good' : '';
$('words').textContent = data.words;
$('most').textContent = `stretched or squeezed ${most.toFixed(1)} times or more`;
$('keys').textContent = dim === 3 ? 'Drag or use the arrow keys to turn; the wheel, two fingers, + and − come nearer.'
  : 'The wheel, two fingers, + and − come nearer.';
for (const part of parts) {
  const item = document.createElement('li'), dot = document.createElement('i');
  dot.style.background = `rgb(${part.tint.map((v) => Math.round(255 * v))})`;
  item.append(dot, part.name);
  $('parts').append(item);
}
try {
  (dim === 3 ? solidView : flatView)();
  canvases.forEach(listen);
  new ResizeObserver(() => draw()).observe(canvases[0]);
  draw();
} catch (error) {
  $('keys').textContent = `${error.message.replace('This mode', 'This page')} The certificate above holds all the same.`;
}
