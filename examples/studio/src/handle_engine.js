// Kernel coordinates: samplings, weights and poses, and the certified map to a pose's outline.
import { Kept } from './kept.js';
import { flatOf } from './shape.js';

const INSIDE = 1;              // Domain.locate()

export function handleOperations(icc) {
  const weights = new Kept();
  let sampling = null, key = '', binding = null, mesh = null;

  /** What is drawn: triangles between samples, with the outline cut as finely. */
  function triangulate(outline, spacing) {
    const boundary = [];
    outline.forEach(([x, y], i) => {
      const [u, v] = outline[(i + 1) % outline.length];
      const n = Math.max(1, Math.round(Math.hypot(u - x, v - y) / spacing));
      for (let k = 0; k < n; ++k) boundary.push(x + ((u - x) * k) / n, y + ((v - y) * k) / n);
    });
    const points = sampling.points(), domain = icc.Domain.polygon(flatOf(outline));
    const ring = icc.Domain.polygon(Float64Array.from(boundary));
    const inner = [];
    const { where } = domain.locate(points), { where: also } = ring.locate(points);
    for (let i = 0; i < where.length; ++i)
      if (where[i] === INSIDE && also[i] === INSIDE) inner.push(points[2 * i], points[2 * i + 1]);
    domain.free();
    ring.free();
    const vertices = Float64Array.from([...boundary, ...inner]);
    return { vertices, nBoundary: boundary.length / 2, triangles: icc.triangulate(boundary.length / 2, vertices) };
  }

  /** Places along lines that are to be samples, one spacing apart. */
  const along = (lines, spacing) => lines.flatMap(({ from, to }) => {
    const n = Math.max(1, Math.ceil(Math.hypot(to[0] - from[0], to[1] - from[1]) / spacing));
    return Array.from({ length: n + 1 }, (_, k) => [0, 1].map((a) => from[a] + ((to[a] - from[a]) * k) / n));
  });

  function sample({ outline, spacing, lines, grid }) {
    const wanted = JSON.stringify([outline, spacing, lines, grid]);
    if (wanted === key) return;
    const domain = icc.Domain.polygon(flatOf(outline)), shape = new icc.Shape([domain]);
    const fixed = along(lines, spacing);
    const made = new icc.Sampling(shape, grid ? { kind: 'grid', spacing, margin: 1 }
      : { kind: 'blue', spacing, ...(fixed.length > 0 ? { fixed } : {}) });
    shape.free();
    domain.free();
    sampling?.free();
    sampling = made;
    key = wanted;
    mesh = triangulate(outline, spacing);
  }

  function become(next, number) {
    weights.become(next, number);
    binding?.free();
    binding = next.bind(mesh.vertices);
  }

  /** The weights of one handle at the vertices that are drawn. */
  function column(handle) {
    if (binding === null) return new Float32Array(0);
    const all = binding.weights().weights, m = binding.info.nHandles, n = all.length / m;
    return Float32Array.from({ length: n }, (_, i) => all[i * m + Math.min(handle, m - 1)]);
  }

  function posed(transforms, changes, handles) {
    const pose = new icc.Pose(flatOf(handles));
    pose.transforms.set(transforms);
    for (const { handle, offset, angle } of changes ?? []) {
      if (angle) pose.turn(handle, angle);
      if (offset) pose.move(handle, Float64Array.from(offset));
    }
    return pose;
  }

  const shown = ({ handle, transforms, handles }) => {
    const { nSamples, nEdge } = sampling.info, { nInfeasible, sigma } = weights.now.info;
    return {
      vertices: mesh.vertices.slice(), triangles: mesh.triangles.slice(), values: column(handle),
      images: binding.pose(posed(transforms, [], handles)), nSamples, nEdge, nInfeasible, sigma,
    };
  };

  const nodesNear = (points, test) => {
    const found = [];
    for (let i = 0; i < points.length / 2; ++i) if (test(points[2 * i], points[2 * i + 1])) found.push(i);
    return found;
  };

  return {
    /** A sampling (if it is another one) and weights. */
    'handles.make'(state) {
      const { handles, bones, lines, method, number, regions } = state;
      sample(state);
      let made = new icc.Weights(sampling, flatOf(handles), {
        method, ...(bones.length > 0 ? { edges: bones } : {}),
        ...(lines.length > 0 ? { lines: lines.map((l) => ({ from: [...l.from, 0], to: [...l.to, 0], parallel: l.parallel })) } : {}),
      });
      for (const region of regions) made = stiff(made, region);
      become(made, number);
      return shown(state);
    },

    'handles.recall'(state) {
      sample(state);
      if (!weights.get(state.number)) return this['handles.make'](state);
      become(weights.get(state.number));
      return shown(state);
    },

    /** A pose with changes since a drag began; only these go with the pointer. */
    'handles.pose'({ transforms, changes, handles }) {
      const pose = posed(transforms, changes, handles);
      return { images: binding.pose(pose), transforms: pose.transforms };
    },

    'handles.weights': ({ handle }) => ({ values: column(handle) }),

    /** Strokes of a brush: each node's weight is changed once, then all are optimised. */
    'handles.paint'({ strokes, radius, amount, rigid, ...state }) {
      const { points, values } = weights.now.nodes(), m = state.handles.length;
      const height = (x, y) => Math.max(...strokes.map(([u, v]) => {
        const d = Math.hypot(x - u, y - v) / radius;
        return d < 1 ? (1 - d * d) ** 2 : 0;
      }));
      const nodes = nodesNear(points, (x, y) => height(x, y) > 0);
      if (nodes.length === 0) return shown(state);
      if (rigid) {
        const { weights: made } = weights.now.stiffen(Uint32Array.from(nodes),
          Float64Array.from(nodes, (i) => Math.max(1e-3, amount * height(points[2 * i], points[2 * i + 1]))));
        become(made, state.number);
        return shown(state);
      }
      const wanted = nodes.flatMap((i) => Array.from({ length: m }, (_, j) => values[i * m + j]
        + (j === state.handle ? amount * height(points[2 * i], points[2 * i + 1]) : 0)));
      become(weights.now.repaint(Uint32Array.from(nodes), Float64Array.from(wanted)), state.number);
      return shown(state);
    },

    'handles.method'(state) {
      become(weights.now.withMethod(state.method), state.number);
      return shown(state);
    },

    /** The certified map to the outline of a pose, with the handles inside where the pose has them. */
    'handles.certify'({ transforms, handles, held }) {
      const images = binding.pose(posed(transforms, [], handles)), n = 2 * mesh.nBoundary;
      const before = mesh.vertices.slice(0, n), after = images.slice(0, n);
      const at = (h) => [0, 1].map((a) => transforms[6 * h + 3 * a] * handles[h][0]
        + transforms[6 * h + 3 * a + 1] * handles[h][1] + transforms[6 * h + 3 * a + 2]);
      const make = (ring, points) => icc.Domain.polygon(ring, { points: points.map((p) => Float64Array.from(p)) });
      try {
        const source = make(before, held.map((h) => handles[h])), target = make(after, held.map(at));
        const map = new icc.Map(source, target), { certified, kind, nSimplices, energy } = map.info;
        const { vertices, images: moved, simplices } = map.mesh();
        for (const object of [source, target, map]) object.free();
        return { vertices, images: moved, triangles: simplices, certified: certified === 1 && kind === 'mesh', nSimplices, energy };
      } catch (error) {
        if (!(error instanceof icc.IccError)) throw error;
        return { error: error.plain, targetDefects: icc.boundaryDefects(after).slice(0, 8) };
      }
    },

    'handles.report': () => ({ report: weights.now.report(mesh.vertices) }),
    'handles.save': () => ({ sampling: sampling.save() }),

    /** A sampling that was saved, in place of one that is made. */
    'handles.load'({ bytes, ...state }) {
      const loaded = icc.Sampling.load(bytes);
      sampling?.free();
      sampling = loaded;
      key = JSON.stringify([state.outline, state.spacing, state.lines, state.grid]);
      mesh = triangulate(state.outline, state.spacing);
      return this['handles.make'](state);
    },
  };

  /** New weights, stiffened at the nodes within a ring. */
  function stiff(made, ring) {
    const { points } = made.nodes(), domain = icc.Domain.polygon(flatOf(ring));
    const { where } = domain.locate(points);
    domain.free();
    const nodes = nodesNear(points, () => true).filter((i) => where[i] === INSIDE);
    if (nodes.length === 0) return made;
    const { weights: stiffened } = made.stiffen(Uint32Array.from(nodes));
    made.free();
    return stiffened;
  }
}
