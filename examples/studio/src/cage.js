// Mode cage: a picture, a cage around a part of it, and the map that follows the cage as it is dragged.
import { ask } from './ask.js';
import { button, make } from './dom.js';
import { CageFiles } from './cage_files.js';
import { comparisonOf, meetingEdges, reached, reportOf } from './cage_report.js';
import { Drawing } from './drawing.js';
import { cageSide } from './cage_side.js';
import { HINTS, TOOLS } from './cage_tools.js';
import { History } from './history.js';
import { foldedOf } from './mesh.js';
import { Overlay } from './overlay.js';
import { pictureOf } from './link.js';
import { Panel } from './panel.js';
import { watchPointer } from './pointer.js';
import { SAMPLES } from './samples.js';
import { moved, movedAll, nearestEdge, outlineOf, same, withCorner, withPart, withoutVertex } from './shape.js';

/** What the page opens with: a corner that has been dragged so far that mean value coordinates fold. */
const OPENING = { sample: 'squares', corners: { 2: [300, 470] } };
const FAINT = { light: [0.91, 0.91, 0.89, 0.72], dark: [0.07, 0.075, 0.08, 0.72] };

export class CageMode {
  view = { look: 'picture', mesh: false, compare: 'mean-value' };
  #remote; #say; #changed; #history; #live; #mesh = null; #number = 0; #mapped = null; #tool = 'move'; #image; #name = '';
  #drawings; #trouble = null; #buttons; #files;
  /** What a test looks at. */
  stats = { frames: 0, uncertified: 0, folded: 0, other: 0, times: [], refused: 0 };

  constructor(remote, { say, changed }) {
    this.#remote = remote;
    this.#say = say;
    this.#changed = changed;
    this.before = new Panel('Before');
    this.after = new Panel('After');
    this.other = new Panel('Compared');
    this.after.element.classList.add('first');
    this.#files = new CageFiles(this, remote, say);
    this.#build();
  }

  #build() {
    const acts = (side) => ({
      grab: (handle) => this.#grab(side, handle), drag: (handle, by) => this.#drag(side, handle, by),
      drop: () => this.#commit(), remove: (handle) => this.#remove(handle), add: (handle) => this.#add(handle),
    });
    this.overlays = { before: new Overlay(this.before, acts('source')), after: new Overlay(this.after, acts('target')),
      other: new Overlay(this.other, {}) };
    this.#drawings = ['before', 'after'].map((side) => new Drawing(this[side], this.overlays[side]));
    watchPointer(this, this.#drawings, this.#remote);
    this.side = cageSide(this, this.#files);
    this.#buttons = Object.entries(TOOLS).map(([key, [text, path]]) =>
      button(text, path, () => this.tool(key), { 'data-tool': key, 'aria-pressed': String(key === 'move') }));
    const tools = make('div', { class: 'tools', role: 'toolbar', 'aria-label': 'Tools' },
      ...this.#buttons.slice(0, 2), make('hr'), ...this.#buttons.slice(2, 5), make('hr'), ...this.#buttons.slice(5));
    this.element = make('div', { class: 'mode cage' }, tools, make('div', { class: 'panels' },
      this.after.element, this.before.element, this.other.element), this.side.element);
  }

  /* -------------------------------------------------------------- the document */

  get #now() { return this.#history.now; }
  get canUndo() { return this.#history?.canUndo ?? false; }
  get canRedo() { return this.#history?.canRedo ?? false; }
  get shapes() { return this.#now; }
  get image() { return this.#image; }

  sample(key, corners = {}) {
    const [, paint, cage] = SAMPLES[key];
    this.#name = key;
    this.open(paint(), outlineOf(cage), outlineOf(cage.map((p, i) => corners[i] ?? p)));
  }

  /** What a visitor sees first. */
  first() {
    this.sample(OPENING.sample, OPENING.corners);
    this.after.wait('Drag a white dot');
  }

  /** Shows a picture with a cage, and where that is now; without a cage, one round most of it. */
  open(image, source = null, target = source) {
    const { width: w, height: h } = image, inset = 0.1;
    this.#image = image;
    for (const panel of [this.before, this.after, this.other]) panel.picture(image);
    if (!source) {
      const corners = [[inset, inset], [1 - inset, inset], [1 - inset, 1 - inset], [inset, 1 - inset]];
      source = target = outlineOf(corners.flatMap((a, k) => [0, 1, 2].map((i) =>
        [w, h].map((size, axis) => size * (a[axis] + ((corners[(k + 1) % 4][axis] - a[axis]) * i) / 3)))));
    }
    this.side.sample.value = this.#name;
    this.#begin(source, target);
  }

  #begin(source, target) {
    this.#history = new History({ source, target, number: ++this.#number });
    this.#mapped = null;
    this.#mesh = null;
    this.#go(this.#now, 'cage.create');
  }

  /** Other shapes, which can be undone. */
  edit(source, target = source) { this.#push(source, target, 'cage.create'); }

  /** A picture of the user's own. */
  own(image) {
    this.#name = '';
    this.open(image);
  }

  /** A new state, and its map. */
  #push(source, target, operation) {
    this.#go(this.#history.push({ source, target, number: ++this.#number }), operation);
  }

  #go(state, operation) {
    this.#live = { source: state.source, target: state.target };
    this.#showShapes();
    this.#ask(operation, state.number);
    this.#changed();
  }

  undo() { if (this.canUndo) this.#go(this.#history.undo(), 'cage.recall'); }
  redo() { if (this.canRedo) this.#go(this.#history.redo(), 'cage.recall'); }
  reset() { if (!same(this.#now.source, this.#now.target)) this.#push(this.#now.source, this.#now.source, 'cage.create'); }

  /* -------------------------------------------------------------- the map */

  #ask(operation, number) {
    const { source, target } = this.#live;
    const follows = operation === undefined && this.#mapped === source;
    const name = operation ?? (follows ? 'cage.follow' : 'cage.create');
    const args = { source, target, number, compare: this.view.compare };
    ask(this.#remote, 'cage', name, args, (result) => this.#take(result, { source, target, number, name }));
  }

  #take(result, asked) {
    this.#trouble = result.error ? result : null;
    if (result.error) {
      ++this.stats.refused;
      // Features could not go straight there: a new map may go another way round.
      if (asked.number !== undefined && asked.name === 'cage.follow' && result.error.code === 'CERTIFICATE')
        this.#ask('cage.create', asked.number);
    } else if (result.images) {
      this.#mesh = { ...result, shape: asked };
      this.#mapped = asked.source;
      this.#count(this.#mesh);
    }
    this.render();
  }

  #count(mesh) {
    const s = this.stats;
    mesh.folded = foldedOf(mesh.vertices, mesh.images, mesh.simplices);
    mesh.otherFolded = mesh.other ? foldedOf(mesh.vertices, mesh.other, mesh.simplices) : null;
    ++s.frames;
    s.uncertified += mesh.certified ? 0 : 1;
    s.folded += mesh.folded.length / 3;
    s.other = Math.max(s.other, (mesh.otherFolded?.length ?? 0) / 3);
    s.times.push(mesh.ms);
  }

  improve() { this.#go(this.#history.push({ ...this.#now, number: ++this.#number }), 'cage.improve'); }

  setView(change) {
    Object.assign(this.view, change);
    if (change.compare) this.#ask('cage.recall', this.#now.number);
    this.render();
  }

  /* -------------------------------------------------------------- what is seen */

  render() {
    const started = performance.now(), mesh = this.#mesh, { look, compare } = this.view, lines = this.view.mesh;
    const dark = matchMedia('(prefers-color-scheme: dark)').matches, whole = FAINT[dark ? 'dark' : 'light'];
    this.other.element.hidden = compare === 'none';
    if (mesh) {
      const from = mesh.vertices, triangles = mesh.simplices;
      this.before.show({ at: from, from, triangles }, { look: look === 'heat' ? 'picture' : look, mesh: lines, whole });
      this.after.show({ at: mesh.images, from, triangles }, { look, mesh: lines });
      if (mesh.other) this.other.show({ at: mesh.other, from, triangles: reached(mesh.other, triangles), folded: mesh.otherFolded },
        { look, mesh: lines });
    }
    this.#showShapes();
    this.#showCertificate();
    this.stats.draw = performance.now() - started;
  }

  #showShapes() {
    const { source, target } = this.#live, bad = this.#trouble;
    this.overlays.before.show(source, { bad: meetingEdges(bad?.sourceDefects) });
    this.overlays.after.show(target, { bad: meetingEdges(bad?.targetDefects) });
    this.overlays.other.show(this.#mesh?.shape.target ?? target, { editable: false });
    this.side.pins.hidden = !source.some((part) => part.kind === 'point');
  }

  #showCertificate() {
    const mesh = this.#mesh, { card, compare } = this.side;
    const { certificate, badge } = reportOf(mesh, this.#trouble);
    if (certificate) card.set(certificate);
    [this.after.badge.dataset.state, this.after.badge.textContent] = badge;
    if (!mesh) return;
    this.other.element.querySelector('strong').textContent = compare.selectedOptions[0].textContent;
    [this.other.badge.dataset.state, this.other.badge.textContent] = comparisonOf(mesh);
  }

  /* -------------------------------------------------------------- edits */

  tool(key) {
    this.#tool = key;
    for (const b of this.#buttons) b.setAttribute('aria-pressed', b.dataset.tool === key);
    for (const d of this.#drawings) d.end();
    if (['hole', 'line', 'point', 'outline'].includes(key))
      this.#drawings.forEach((d, k) => d.begin(key, (points) => this.#drawn(key, points, k === 0)));
    if (key === 'corner') this.#drawings.forEach((d, k) => d.begin('point', ([p]) => this.#cornerAt(p, k === 0)));
    this.#say(HINTS[key] ?? '');
  }

  async #drawn(kind, points, before) {
    this.tool('move');
    if (kind === 'outline') { const shape = outlineOf(points); this.#push(shape, shape, 'cage.create'); return; }
    const result = await this.#remote.call('cage.points', { points: Float64Array.from(points.flat()), forth: before });
    const others = points.map((_, i) => [result.points[2 * i], result.points[2 * i + 1]]);
    if (others.length === 0 || others.flat().some(Number.isNaN)) { this.#say('It has to lie inside the cage.'); return; }
    const part = (p) => ({ kind, points: p, ...(kind === 'point' ? { radius: 0 } : {}) });
    const { source, target } = this.#now;
    this.#push(withPart(source, part(before ? points : others)), withPart(target, part(before ? others : points)), 'cage.create');
  }

  #cornerAt(at, before) {
    const shape = before ? this.#now.source : this.#now.target;
    const found = shape.map((part, k) => ({ k, ...(part.kind === 'point' ? { distance: Infinity } : nearestEdge(part, at)) }))
      .sort((a, b) => a.distance - b.distance)[0];
    this.#addAt(found.k, found.i, Math.min(0.9, Math.max(0.1, found.t)));
  }

  #add(handle) { if (handle.vertices) this.#addAt(handle.part, handle.vertices[0], 0.5); }

  #addAt(k, i, t) {
    const { source, target } = this.#now;
    if (source[k].kind === 'point') return;
    this.#push(withCorner(source, k, i, t), withCorner(target, k, i, t), 'cage.create');
    this.overlays.after.focus(k, i + 1);
  }

  #remove({ part, type, vertices }) {
    if (type === 'all' || type === 'edge') return;
    const { source, target } = this.#now;
    const without = (shape) => (type === 'part' ? shape.filter((_, k) => k !== part) : withoutVertex(shape, part, vertices[0]));
    if (without(source) === null) { this.#say('A cage has three corners at least.'); return; }
    this.#push(without(source), without(target), 'cage.create');
  }

  #grab(side, handle) {
    if (this.#tool !== 'remove') return true;
    this.#remove(handle);
    return false;
  }

  /** In the picture before, what has not been moved yet moves in both. */
  #drag(side, handle, by) {
    const apply = (shape) => (handle.type === 'all' ? movedAll(shape, by) : moved(shape, handle.part, handle.vertices, by));
    const { source, target } = this.#live;
    if (side === 'target') this.#live = { source, target: apply(target) };
    else this.#live = { source: apply(source), target: this.#together(handle) ? apply(target) : target };
    this.#showShapes();
    this.#ask();
  }

  #together({ type, part, vertices }) {
    const { source, target } = this.#live;
    if (type === 'all') return same(source, target);
    const picked = (shape) => shape[part].points.filter((_, i) => vertices === null || vertices.includes(i));
    return same(picked(source), picked(target));
  }

  #commit() {
    const { source, target } = this.#live;
    if (source === this.#now.source && target === this.#now.target) return;
    this.#push(source, target, source === this.#mapped ? 'cage.follow' : 'cage.create');
  }

  pinSize(radius) {
    const sized = (shape) => shape.map((part) => (part.kind === 'point' ? { ...part, radius } : part));
    this.#push(sized(this.#now.source), sized(this.#now.target), 'cage.create');
  }

  /* -------------------------------------------------------------- files and links */

  /** A file that was opened, dropped or pasted. */
  take(file) { return this.#files.take(file); }

  /** What a link has: the cages, and the picture if it is one of ours. */
  get state() { return { mode: 'cage', sample: this.#name, source: this.#now.source, target: this.#now.target, view: this.view }; }

  async restore({ sample, picture, source, target, view }) {
    Object.assign(this.view, view);
    const own = picture ? await pictureOf(picture) : null;
    this.#name = own ? '' : sample in SAMPLES ? sample : 'butterfly';
    this.open(own ?? SAMPLES[this.#name][1](), source, target);
  }
}
