// Mode handles: the interface of the thesis (Kernel Coordinates, section 6.3). A pose on one side, the
// weights of the chosen handle on the other, where they can be painted.
import { ask } from './ask.js';
import { button, make } from './dom.js';
import { Brush } from './brush.js';
import { Drawing } from './drawing.js';
import { HandleFiles } from './handle_files.js';
import { handleSide } from './handle_side.js';
import { HINTS, TOOLS } from './handle_tools.js';
import { History } from './history.js';
import { foldedOf, rimOf } from './mesh.js';
import { Overlay } from './overlay.js';
import { Panel } from './panel.js';
import { PoseCertificate, heldOf } from './pose_certificate.js';
import { atRest, parallelEnd, placeOf, restOf, turnPair } from './pose.js';
import { RIGS } from './rigs.js';
import { SAMPLES } from './samples.js';

const LEAST_LOG = 4;           // decades of the logarithmic scale

export class HandleMode {
  view = { scale: 'linear', keep: false };
  stats = { frames: 0, folded: 0, times: [] };
  certificate = new PoseCertificate();
  #remote; #say; #changed; #modes; #history = null; #live = null; #mesh = null; #values = null; #chosen = 0; #number = 0;
  #image; #tool = 'move'; #brush = { radius: 60, amount: 0.3 }; #drag = null; #bone = null; #buttons;

  constructor(remote, { say, changed, modes }) {
    Object.assign(this, { pose: new Panel('Pose'), rest: new Panel('Weights') });
    [this.#remote, this.#say, this.#changed, this.#modes] = [remote, say, changed, modes];
    this.pose.element.classList.add('first');
    this.pose.wait('Drag a yellow dot; turn it by the right button');
    this.overlays = {
      pose: new Overlay(this.pose, {
        grab: (h) => this.#grab(h), drag: (h, by) => this.#change(h, { by }), turn: (h, angle) => this.#change(h, { angle }),
        drop: () => this.#drop(), remove: (h) => this.#remove(h),
      }),
      rest: new Overlay(this.rest, { grab: (h) => this.#grab(h), drag: () => {}, drop: () => {} }),
    };
    this.drawings = [new Drawing(this.pose, this.overlays.pose), new Drawing(this.rest, this.overlays.rest)];
    this.brush = new Brush(this.rest, this.overlays.rest, { stroke: (at) => this.#preview(at), done: (strokes) => this.#paint(strokes) });
    this.side = handleSide(this, new HandleFiles(this, remote, say));
    this.#buttons = Object.entries(TOOLS).map(([key, [text, path]]) =>
      button(text, path, () => this.tool(key), { 'data-tool': key, 'aria-pressed': String(key === 'move') }));
    this.element = make('div', { class: 'mode handles' },
      make('div', { class: 'tools', role: 'toolbar', 'aria-label': 'Tools' }, ...this.#buttons),
      make('div', { class: 'panels two' }, this.pose.element, this.rest.element), this.side.element);
  }

  enter(rig = 'star') { if (!this.#history) this.rig(rig); }
  render() { this.#show(); }

  get #now() { return this.#history.now; }
  get canUndo() { return this.#history?.canUndo ?? false; }
  get canRedo() { return this.#history?.canRedo ?? false; }
  undo() { if (this.canUndo) this.#go(this.#history.undo(), 'handles.recall'); }
  redo() { if (this.canRedo) this.#go(this.#history.redo(), 'handles.recall'); }
  get state() { return this.#now; }

  rig(key) {
    const cage = this.#modes.cage;
    const outline = key === 'cage' ? cage.shapes.source[0].points : null;
    const rig = key === 'cage' ? { outline, handles: outline, bones: outline.map((_, i) => [i, (i + 1) % outline.length]) } : RIGS[key][1];
    this.#image = rig.sample ? SAMPLES[rig.sample][1]() : cage.image;
    for (const panel of [this.pose, this.rest]) panel.picture(this.#image);
    this.side.rig.value = key;
    this.tool('move');
    this.#chosen = 0;
    const { method = 'qp', grid = false, handles, bones } = rig;
    this.#history = new History({ outline: rig.outline, handles, bones, lines: [], regions: [], paintings: [], method, grid, spacing: 12,
      transforms: atRest(handles.length), number: ++this.#number });
    this.#go(this.#now, 'handles.make');
  }

  /** A new state; an operation where the weights change with it. */
  edit(change, operation, more) { this.#push(change, operation, more); }

  #push(change, operation = null, more = {}) {
    const state = { ...this.#now, ...change, ...(operation ? { number: ++this.#number } : {}) };
    this.#go(this.#history.push(state), operation ?? 'handles.pose', more, () => this.#withdraw(state));
  }

  /** A state that cannot be had is forgotten: what was before it stays. */
  #withdraw(state) {
    if (state !== this.#now) return;
    this.#live = this.#history.withdraw();
    this.side.setState(this.#now);
    this.#changed();
  }

  #go(state, operation, more = {}, refused = () => {}) {
    this.#live = state;
    this.certificate.clear();
    this.side.setState(state);
    this.#changed();
    ask(this.#remote, 'handles', operation, { ...state, handle: this.#chosen, ...this.#kept, ...more }, (result) => {
      if (result.error) refused();
      this.#take(result);
      if (this.view.keep && !result.map) this.certify();
    });
  }

  #take(result) {
    if (result.error) { this.#say(`${result.error.message}.`); this.#show(); return; }
    const { images, vertices, triangles, values } = result;
    if (triangles) this.#mesh = { vertices, triangles, ...result };
    if (values) this.#values = values;
    if (images) this.#mesh.images = images;
    if (result.map) this.certificate.take(result.map);
    if (result.transforms) this.#live = { ...this.#live, transforms: result.transforms };
    this.#mesh.folded = foldedOf(this.#mesh.vertices, this.#mesh.images, this.#mesh.triangles);
    ++this.stats.frames;
    this.stats.folded = this.#mesh.folded.length / 3;
    this.stats.times.push(result.ms);
    this.#show();
  }

  /* -------------------------------------------------------------- what is seen */

  #show() {
    const mesh = this.certificate.mesh ?? this.#mesh, rest = this.#mesh;
    if (!mesh || !this.#live) return;
    this.pose.show({ at: mesh.images, from: mesh.vertices, triangles: mesh.triangles, folded: mesh.folded }, { look: 'picture' });
    const log = this.view.scale === 'log';
    const colours = this.#values?.map((w) => (log ? 1 + Math.log10(Math.max(Math.abs(w), 10 ** -LEAST_LOG)) / LEAST_LOG : w));
    this.rest.show({ at: rest.vertices, from: rest.vertices, triangles: rest.triangles, values: colours }, { look: 'values', over: 0.86 });
    this.ends.firstChild.textContent = log ? `10⁻⁴` : '0';
    this.rest.note.textContent = `of handle ${this.#chosen + 1}`;
    this.#showHandles(mesh);
    this.#showCard(mesh);
    this.side.setFacts({ Handles: this.#live.handles.length, Samples: rest.nSamples, 'Beyond reach of QP': rest.nInfeasible,
      'Width of kernel': `${rest.sigma.toFixed(1)} px` });
  }

  #showHandles(mesh) {
    const { handles, transforms, bones, lines, regions, outline } = this.#live;
    const places = handles.map((_, h) => placeOf(transforms, handles, h));
    const parts = (at) => [...bones.map(([a, b], k) => ({ kind: 'bone', points: [at[a], at[b]], name: String(k + 1) })),
      ...at.map((p, h) => ({ kind: 'point', points: [p], name: `handle ${h + 1}` }))];
    this.overlays.pose.show([{ kind: 'outline', points: rimOf(mesh) }, ...parts(places)], { editable: 'points' });
    this.overlays.rest.show([{ kind: 'outline', points: outline }, ...lines.map((l) => ({ kind: 'line', points: [l.from, l.to] })),
      ...regions.map((points) => ({ kind: 'region', points })), ...parts(handles)], { editable: 'points' });
    this.overlays.pose.choose(1 + bones.length + this.#chosen);
    this.overlays.rest.choose(1 + lines.length + regions.length + bones.length + this.#chosen);
  }

  #showCard(mesh) {
    const { card, badge } = this.certificate.report(mesh);
    this.side.card.set(card);
    [this.pose.badge.dataset.state, this.pose.badge.textContent] = badge;
  }

  setView(change) { Object.assign(this.view, change); this.#show(); }
  setBrush(change) { Object.assign(this.#brush, change); this.brush.radius = this.#brush.radius; }

  /* -------------------------------------------------------------- the pose */

  /** The handles that a grip of the overlay stands for: one, or the two of a bone. */
  #handlesOf({ type, part }) {
    const { bones } = this.#live;
    return type === 'edge' ? bones[part - 1] : [part - 1 - bones.length];
  }

  #grab(handle) {
    const { bones, lines, regions } = this.#live;
    const fromRest = handle.element.closest('svg') === this.rest.svg;
    const own = fromRest ? { ...handle, part: handle.part - lines.length - regions.length } : handle;
    const picked = this.#handlesOf(own);
    if (this.#tool === 'remove') { this.#remove(own); return false; }
    if (own.type === 'vertex') this.choose(picked[0]);
    if (this.#tool === 'bone' && own.type === 'vertex') { this.#join(picked[0], bones); return false; }
    return !fromRest;
  }

  choose(h) {
    this.#chosen = h;
    ask(this.#remote, 'weights', 'handles.weights', { handle: h }, ({ values }) => { if (values?.length) { this.#values = values; this.#show(); } });
  }

  #join(h, bones) {
    const a = this.#bone;
    if (a === null || a === h) { this.#bone = h; this.#say('Click the other end of the bone.'); return; }
    this.tool('move');
    const alike = ([x, y]) => (x === a && y === h) || (x === h && y === a);
    this.#push({ bones: bones.some(alike) ? bones.filter((b) => !alike(b)) : [...bones, [a, h]] }, 'handles.make');
  }

  /** All changes since a drag began, so that a frame that is skipped is not missed. */
  #change(handle, { by = [0, 0], angle = 0 }) {
    const picked = this.#handlesOf(handle), { handles } = this.#now;
    this.#drag ??= { transforms: this.#live.transforms, offset: [0, 0], angle: 0, asked: 0, shown: 0 };
    const d = this.#drag, number = ++d.asked;
    d.offset = [d.offset[0] + by[0], d.offset[1] + by[1]];
    d.angle += angle;
    const places = picked.map((h) => placeOf(d.transforms, handles, h));
    const changes = d.angle && picked.length > 1
      ? turnPair(picked, places, d.angle).map((c) => ({ ...c, offset: c.offset.map((v, a) => v + d.offset[a]) }))
      : picked.map((h) => ({ handle: h, offset: d.offset, angle: d.angle }));
    if (!this.view.keep) this.certificate.clear();
    ask(this.#remote, 'handles', 'handles.pose', { transforms: d.transforms, changes, handles, ...this.#kept }, (result) => {
      this.#take(result);
      d.shown = number;
      if (d.dropped && d.shown === d.asked) this.#settle();
    });
  }

  #drop() {
    const d = this.#drag;
    if (!d) return;
    this.#drag = null;
    d.dropped = true;
    if (d.shown === d.asked) this.#settle();
  }

  /** The drag has ended, and its last pose has come. */
  #settle() {
    if (this.#live.transforms === this.#now.transforms) return;
    this.#live = this.#history.push({ ...this.#now, transforms: this.#live.transforms });
    this.#changed();
  }

  reset() { this.#push({ transforms: atRest(this.#now.handles.length) }); }
  method(method) { this.#push({ method, paintings: [] }, 'handles.method'); }
  spacing(spacing) { this.#push({ spacing }, 'handles.make'); }
  grid(grid) { this.#push({ grid }, 'handles.make'); }

  get #kept() { return this.view.keep ? { held: heldOf(this.#live) } : {}; }

  async certify() {
    this.certificate.take(await this.#remote.call('handles.certify', { ...this.#live, held: heldOf(this.#live) }));
    this.#show();
    this.#say(this.certificate.reason ?? '');
  }

  /** Whether each pose is to be certified as it is dragged. */
  keep(keep) {
    this.view.keep = keep;
    if (keep) this.certify();
  }

  /* -------------------------------------------------------------- edits of the rig */

  tool(key) {
    this.#tool = key;
    this.#bone = null;
    for (const b of this.#buttons) b.setAttribute('aria-pressed', b.dataset.tool === key);
    for (const d of this.drawings) d.end();
    this.brush.set(key === 'paint' || key === 'rigid');
    if (key === 'handle') this.drawings.forEach((d, k) => d.begin('point', ([p]) => this.#addHandle(p, k === 0)));
    if (key === 'line' || key === 'parallel') this.drawings[1].begin('line', (points) => this.#addLine(points, key === 'parallel'));
    if (key === 'region') this.drawings[1].begin('region', (points) => { this.tool('move'); this.#push({ regions: [...this.#now.regions, points] }, 'handles.make'); });
    this.#say(HINTS[key] ?? '');
  }

  #addHandle(at, posed) {
    this.tool('move');
    const p = posed ? restOf(this.#mesh, at) : at;
    if (!p) { this.#say('A handle lies inside the shape.'); return; }
    const { handles, transforms } = this.#now, moved = posed ? [at[0] - p[0], at[1] - p[1]] : [0, 0];
    this.#chosen = handles.length;
    this.#push({ handles: [...handles, p], transforms: Float64Array.from([...transforms, 1, 0, moved[0], 0, 1, moved[1]]) }, 'handles.make');
  }

  #addLine([from, to], parallel) {
    this.tool('move');
    const { lines } = this.#now;
    if (parallel && lines.length === 0) { this.#say('There is no line yet that it could be parallel to.'); return; }
    const line = { from, to: parallel ? parallelEnd(lines.at(-1), from, to) : to, parallel: parallel ? lines.length : 0 };
    this.#push({ lines: [...lines, line] }, 'handles.make');
  }

  #remove(handle) {
    const picked = this.#handlesOf(handle), { handles, bones, transforms, paintings } = this.#now;
    if (picked.length > 1) { this.#push({ bones: bones.filter((b) => b !== picked) }, 'handles.make'); return; }
    const [h] = picked, low = (i) => (i > h ? i - 1 : i);
    if (handles.length <= 3) { this.#say('There are three handles at least.'); return; }
    this.#chosen = 0;
    this.#push({ handles: handles.filter((_, i) => i !== h), bones: bones.filter((b) => !b.includes(h)).map((b) => b.map(low)),
      paintings: paintings.filter((p) => p.rigid || p.handle !== h).map((p) => ({ ...p, handle: low(p.handle) })),
      transforms: transforms.filter((_, i) => Math.floor(i / 6) !== h) }, 'handles.make');
  }

  /** What the brush will do, before it is optimised. */
  #preview([u, v]) {
    if (this.#tool !== 'paint') return;
    const { vertices } = this.#mesh, { radius, amount } = this.#brush;
    this.#values = this.#values.map((w, i) => {
      const d = Math.hypot(vertices[2 * i] - u, vertices[2 * i + 1] - v) / radius;
      return d < 1 ? w + (amount * (1 - d * d) ** 2) / 4 : w;
    });
    this.#show();
  }

  #paint(strokes) {
    const painting = { handle: this.#chosen, strokes, ...this.#brush, rigid: this.#tool === 'rigid' };
    this.#push({ paintings: [...this.#now.paintings, painting] }, 'handles.paint');
  }
}
