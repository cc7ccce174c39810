// Kernel coordinates: blending weights for handles. See icc/kernel.h.
import { Handle, optional, room } from './core.js';
import { constantOf } from './names.js';
import { exactly, flat, indices, onePoint, whole } from './points.js';

const methodNumber = (method) => (typeof method === 'string' ? constantOf('ICC_WEIGHTS_', method) : method);

/** The classes Shape, Sampling, Weights, Binding and Pose of an instance. */
export function kernelOf(core) {
  class Shape extends Handle {
    #dim;
    /** Regions are Domains; curves are { vertices, segments }. */
    constructor(regions, { vertices = [], segments = [], dim = regions[0]?.dim ?? 2 } = {}) {
      const v = flat(vertices, dim), s = indices(segments, 2);
      super(core, null,
        () => core.call('icc_shape_create', dim, regions.length, regions, v.length / dim, v, s.length / 2, s), 'icc_shape_free');
      this.#dim = dim;
    }

    get dim() { return this.#dim; }
  }

  class Sampling extends Handle {
    /** options as in icc_sampling_options: { kind: 'blue', spacing, fixed, ... }. */
    constructor(shape, options = null) {
      super(core, shape, () => core.call('icc_sampling_create', shape, withCount(options, 'fixed', 'nFixed', shape.dim)),
        'icc_sampling_free');
    }

    static fromPoints(shape, points) {
      const p = flat(points, shape.dim);
      return new Sampling(core.made('icc_sampling_create_from_points', shape, p.length / shape.dim, p));
    }

    static load(bytes) { return new Sampling(core.made('icc_sampling_load', bytes.length, bytes)); }
    save() { return core.save('icc_sampling_save', this); }
    get info() { return core.info('icc_sampling_get_info', this); }

    points() {
      const { dim, nSamples } = this.info, out = new Float64Array(nSamples * dim);
      core.call('icc_sampling_get_points', this, out);
      return out;
    }
  }

  class Weights extends Handle {
    /** options as in icc_weights_options: { method: 'qp', edges, lines: [{ from, to, parallel }], ... }. */
    constructor(sampling, handles, options = null) {
      super(core, sampling, () => made(sampling, flat(handles, sampling.dim), options), 'icc_weights_free');
    }

    get info() { return core.info('icc_weights_get_info', this); }
    get timings() { return core.info('icc_weights_get_timings', this); }

    /** The places that carry weights: { points, initial, values, status }. */
    nodes() {
      const { dim, nNodes, nHandles } = this.info;
      const out = {
        points: new Float64Array(nNodes * dim), initial: new Float64Array(nNodes * nHandles),
        values: new Float64Array(nNodes * nHandles), status: new Int32Array(nNodes),
      };
      core.call('icc_weights_get_nodes', this, out.points, out.initial, out.values, out.status);
      return out;
    }

    /** Weights of all handles at points, point after point. */
    evaluate(points, { out, gradients = null } = {}) {
      const { dim, nHandles } = this.info, p = flat(points, dim), n = p.length / dim;
      const values = room(out, n * nHandles);
      core.call('icc_weights_evaluate', this, n, p, values, optional(gradients, n * nHandles * dim, 'gradients'), null, null);
      return values;
    }

    /** The dual function of a node at points: 1 at the node, 0 at all others, interpolated as weights are. */
    dual(node, points, { out } = {}) {
      const p = flat(points, this.dim), n = p.length / this.dim;
      const values = room(out, n);
      core.call('icc_weights_get_dual', this, node, n, p, values);
      return values;
    }

    report(points) {
      const p = flat(points, this.dim);
      return core.info('icc_weights_get_report', this, p.length / this.dim, p);
    }

    /** New weights, with a brush applied to the weight of one handle. */
    paint(handle, centre, radius, amount) {
      return new Weights(core.made('icc_weights_paint', this, handle, onePoint(centre, this.dim), radius, amount));
    }

    /** New weights, which start from your own values at some nodes. */
    repaint(nodes, values) {
      const given = indices(nodes), all = exactly(flat(values), given.length * this.info.nHandles, 'values');
      return new Weights(core.made('icc_weights_repaint', this, given.length, given, all));
    }

    withMethod(method) { return new Weights(core.made('icc_weights_with_method', this, methodNumber(method))); }

    /** New weights, with a part that moves as if it were rigid: { weights, energy }. `energy` is half the sum of its squared
     *  derivatives, before and after. */
    stiffen(nodes, rigidity = null) {
      const energy = new Float64Array(2), part = indices(nodes);
      const stiff = rigidity === null ? null : exactly(rigidity, part.length, 'rigidity');
      const address = core.made('icc_weights_stiffen', this, part.length, part, stiff, energy);
      return { weights: new Weights(address), energy };
    }

    /** Binds points to the handles, for repeated poses. */
    bind(points, options) { return new Binding(this, points, options); }
  }

  class Binding extends Handle {
    constructor(weights, points, { derivatives = false } = {}) {
      super(core, weights, () => bound(weights, flat(points, weights.dim), derivatives), 'icc_binding_free');
    }

    static load(bytes) { return new Binding(core.made('icc_binding_load', bytes.length, bytes)); }
    save() { return core.save('icc_binding_save', this); }

    get info() {
      const points = new Uint32Array(1), handles = new Uint32Array(1), dim = new Int32Array(1);
      core.call('icc_binding_get_counts', this, points, handles, dim);
      return { nPoints: points[0], nHandles: handles[0], dim: dim[0] };
    }

    /** The handles and the weights of the points: { handles, weights }. */
    weights() {
      const { nPoints, nHandles, dim } = this.info;
      const out = { handles: new Float64Array(nHandles * dim), weights: new Float64Array(nPoints * nHandles) };
      core.call('icc_binding_get_weights', this, out.handles, out.weights);
      return out;
    }

    /** The points under a Pose. `jacobians` receives derivatives, if the binding has them. */
    pose(pose, { out, jacobians = null } = {}) {
      const { nPoints, nHandles, dim } = this.info, images = room(out, nPoints * dim);
      if (!(pose instanceof Pose)) throw new TypeError('pose must be a Pose');
      exactly(pose.transforms, nHandles * dim * (dim + 1), `the pose of ${nHandles} handles`);
      core.call('icc_binding_pose', this, pose.transforms, images, optional(jacobians, nPoints * dim * dim, 'jacobians'));
      return images;
    }
  }

  /** A transform for each handle, which you may change. */
  class Pose {
    #dim; #handles; #transforms;

    constructor(handles, dim = 2) {
      this.#dim = dim;
      this.#handles = flat(handles, dim).slice();
      this.#transforms = new Float64Array(this.#handles.length * (dim + 1));
      this.reset();
    }

    get dim() { return this.#dim; }
    get handles() { return this.#handles; }
    get transforms() { return this.#transforms; }

    reset() { core.call('icc_pose_reset', this.dim, this.handles.length / this.dim, this.transforms); return this; }

    #of(handle) {
      const n = this.dim * (this.dim + 1);
      if (!(whole(handle, 0, 'handle') * this.dim < this.handles.length)) throw new RangeError(`there is no handle ${handle}`);
      return this.transforms.subarray(handle * n, (handle + 1) * n);
    }

    move(handle, offset) { core.call('icc_pose_move', this.dim, this.#of(handle), onePoint(offset, this.dim)); return this; }

    /** Turns a handle by an angle in radians, counter-clockwise with y upwards; in space about an axis. */
    turn(handle, angle, axis = null) {
      const at = this.handles.subarray(handle * this.dim, (handle + 1) * this.dim);
      core.call('icc_pose_turn', this.dim, this.#of(handle), at, axis === null ? null : onePoint(axis, 3), angle);
      return this;
    }
  }

  function withCount(options, member, count, width) {
    if (!options?.[member]) return options;
    const values = flat(options[member], width);
    return { ...options, [member]: values, [count]: values.length / width };
  }

  function made(sampling, handles, options) {
    let o = options ?? {};
    if (o.edges) o = { ...o, edges: indices(o.edges, 2) };
    if (o.edges) o.nEdges = o.edges.length / 2;
    if (o.initialWeights)
      o = { ...o, initialWeights: exactly(flat(o.initialWeights), sampling.info.nSamples * handles.length / sampling.dim, 'initialWeights') };
    if (o.lines) o = { ...o, nLines: o.lines.length };
    return core.call('icc_weights_create', sampling, handles.length / sampling.dim, handles, o);
  }

  function bound(weights, points, derivatives) {
    return core.call('icc_binding_create', weights, points.length / weights.dim, points, Number(derivatives));
  }

  return { Shape, Sampling, Weights, Binding, Pose };
}
