// Kernel coordinates: samplings, weights and poses, and the certified map to a pose's outline.
import { Kept } from './kept.js';
import { placeOf } from './pose.js';
import { flatOf } from './shape.js';

const INSIDE = 1;              // Domain.locate()
const LEAST_RIGID = 1e-3;      // at the rim of a rigid brush
const FRAME_STEPS = 2;         // of improvement, in a frame of dragging

export function handleOperations(icc) {
  const weights = new Kept();
  let ground = { key: null, sampling: null, mesh: null }, binding = null;
  let followed = null;         // a certified map, and what it is of: { map, mesh, of }

  /** What is drawn: triangles between samples, with the outline cut as finely. */
  function triangulate({ outline, spacing }, sampling) {
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

  /** Places along lines, one spacing apart: samples of blue noise, so that the lines' nodes are among them. */
  const along = (lines, spacing) => lines.flatMap(({ from, to }) => {
    const n = Math.max(1, Math.ceil(Math.hypot(to[0] - from[0], to[1] - from[1]) / spacing));
    return Array.from({ length: n + 1 }, (_, k) => [0, 1].map((a) => from[a] + ((to[a] - from[a]) * k) / n));
  });

  /** A grid is the same whatever lines there are: samples within half a spacing of a line's nodes carry no weights. */
  const keyOf = ({ outline, spacing, lines, grid }) => JSON.stringify([outline, spacing, grid || lines]);

  function sampled({ outline, spacing, lines, grid }) {
    const domain = icc.Domain.polygon(flatOf(outline)), shape = new icc.Shape([domain]), fixed = along(lines, spacing);
    try {
      return new icc.Sampling(shape, grid ? { kind: 'grid', spacing, margin: 1 }
        : { kind: 'blue', spacing, ...(fixed.length > 0 ? { fixed } : {}) });
    } finally {
      shape.free();
      domain.free();
    }
  }

  /** Runs `work` with the samples of a state, or others that are given, and what is drawn. They are kept if it succeeds. */
  function standing(state, work, given = null) {
    const key = keyOf(state);
    if (!given && key === ground.key) return work(ground);
    const sampling = given ?? sampled(state);
    try {
      const next = { key, sampling, mesh: triangulate(state, sampling) }, result = work(next);
      ground.sampling?.free();
      ground = next;
      return result;
    } catch (error) {
      sampling.free();
      throw error;
    }
  }

  /** Weights, with all that has been done to them. */
  function madeOf({ handles, bones, lines, method, regions, paintings }, sampling) {
    let made = new icc.Weights(sampling, flatOf(handles), {
      method, ...(bones.length > 0 ? { edges: bones } : {}),
      ...(lines.length > 0 ? { lines: lines.map((l) => ({ from: [...l.from, 0], to: [...l.to, 0], parallel: l.parallel })) } : {}),
    });
    for (const region of regions) made = stiff(made, region);
    for (const painting of paintings) made = instead(made, painted(made, painting));
    return made;
  }

  const make = (state, given) => standing(state, ({ sampling, mesh }) => {
    become(madeOf(state, sampling), state.number, mesh);
    return shown(state, mesh, sampling);
  }, given);

  function become(next, number, mesh = ground.mesh) {
    const bound = next.bind(mesh.vertices);
    weights.become(next, number);
    binding?.free();
    binding = bound;
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

  const shown = ({ handle, transforms, handles }, mesh = ground.mesh, sampling = ground.sampling) => {
    const { nSamples, nEdge } = sampling.info, { nInfeasible, sigma } = weights.now.info;
    return {
      vertices: mesh.vertices.slice(), triangles: mesh.triangles.slice(), values: column(handle),
      images: binding.pose(posed(transforms, [], handles)), nSamples, nEdge, nInfeasible, sigma,
    };
  };

  /** What comes in place of weights, which are freed. */
  function instead(made, next) {
    if (next !== made) made.free();
    return next;
  }

  /** Weights, stiffened at the nodes within a ring. */
  function stiff(made, ring) {
    const domain = icc.Domain.polygon(flatOf(ring)), { where } = domain.locate(made.nodes().points);
    domain.free();
    const nodes = Uint32Array.from(where.keys()).filter((i) => where[i] === INSIDE);
    return nodes.length === 0 ? made : instead(made, made.stiffen(nodes).weights);
  }

  /** Weights with a painting: strokes of a brush change the weight of each node once, by the stroke that reaches it
   *  most, then all are optimised. */
  function painted(made, { handle, strokes, radius, amount, rigid }) {
    const { points, values } = made.nodes(), m = made.info.nHandles;
    const height = (i) => Math.max(...strokes.map(([u, v]) => {
      const x = points[2 * i] - u, y = points[2 * i + 1] - v, d = (x * x + y * y) / (radius * radius);
      return d < 1 ? (1 - d) * (1 - d) : 0;
    }));
    const heights = Float64Array.from({ length: points.length / 2 }, (_, i) => height(i));
    const nodes = Uint32Array.from(heights.keys()).filter((i) => heights[i] > 0);
    if (nodes.length === 0) return made;
    if (rigid) return made.stiffen(nodes, Float64Array.from(nodes, (i) => Math.max(LEAST_RIGID, amount * heights[i]))).weights;
    for (const i of nodes) values[i * m + handle] += amount * heights[i];
    return made.repaint(nodes, Float64Array.from([...nodes].flatMap((i) => [...values.subarray(i * m, i * m + m)])));
  }

  const nameOf = ({ handles, held }) => JSON.stringify(held.map((h) => handles[h]));

  /** The certified map of an earlier pose, if it is of the same shape with the same handles held inside. */
  const follows = (state) => (followed?.mesh === ground.mesh && followed.of === nameOf(state) ? followed.map : null);

  /** The map to a target: the one that there is goes there if it can, in the few steps of a frame. */
  function mapTo(target, source, old) {
    try { if (old) return old.retarget(target, FRAME_STEPS); } catch (error) {
      if (error.code !== 'CERTIFICATE') throw error;
    }
    return new icc.Map(source, target);
  }

  /** The certified map to the outline of a pose, with the handles inside where the pose has them. */
  function certified({ transforms, handles, held }, images, old = null) {
    const { mesh } = ground, n = 2 * mesh.nBoundary, rim = images.slice(0, n), places = held.map((h) => placeOf(transforms, handles, h));
    const domainOf = (ring, points) => icc.Domain.polygon(ring, { points: points.map((p) => Float64Array.from(p)) });
    const domains = [];
    try {
      domains.push(domainOf(mesh.vertices.slice(0, n), held.map((h) => handles[h])), domainOf(rim, places));
      const map = mapTo(domains[1], domains[0], old), { certified: proved, kind } = map.info;
      followed?.map.free();
      followed = { map, mesh, of: nameOf({ handles, held }) };
      const { vertices, images: moved, simplices: triangles } = map.mesh();
      return { vertices, images: moved, triangles, certified: proved === 1 && kind === 'mesh' };
    } catch (error) {
      if (!(error instanceof icc.IccError)) throw error;
      const outside = error.code === 'OUTSIDE' ? { outside: held[error.index] } : {};
      return { error: error.plain, ...outside, targetDefects: icc.boundaryDefects(rim).slice(0, 8) };
    } finally {
      for (const domain of domains) domain.free();
    }
  }

  return {
    /** A sampling (if it is another one) and weights. */
    'handles.make': (state) => make(state),

    /** The weights of a state that were kept, or new ones. */
    'handles.recall': (state) => (weights.get(state.number) ? standing(state, ({ sampling, mesh }) => {
      become(weights.get(state.number), undefined, mesh);
      return shown(state, mesh, sampling);
    }) : make(state)),

    /** A pose with changes since a drag began; only these go with the pointer. With `held`, the certified map, too. */
    'handles.pose'({ transforms, changes, handles, held }) {
      const pose = posed(transforms, changes, handles), images = binding.pose(pose);
      const moved = { transforms: pose.transforms, handles, held };
      return { images, transforms: pose.transforms, ...(held ? { map: certified(moved, images, follows(moved)) } : {}) };
    },

    'handles.weights': ({ handle }) => ({ values: column(handle) }),

    /** The last of the paintings, on the weights that there are. */
    'handles.paint'(state) {
      become(painted(weights.now, state.paintings.at(-1)), state.number);
      return shown(state);
    },

    /** Paintings are lost, as in the thesis; regions stay rigid. */
    'handles.method'(state) {
      become(state.regions.reduce(stiff, weights.now.withMethod(state.method)), state.number);
      return shown(state);
    },

    /** The certified map of a pose, made anew. */
    'handles.certify': (state) => certified(state, binding.pose(posed(state.transforms, [], state.handles))),

    'handles.report': () => ({ report: weights.now.report(ground.mesh.vertices) }),
    'handles.save': () => ({ sampling: ground.sampling.save() }),

    /** A sampling that was saved, in place of one that is made. */
    'handles.load': ({ bytes, ...state }) => make(state, icc.Sampling.load(bytes)),
  };
}
