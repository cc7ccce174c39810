// Mode points: places on one picture and the same places on another, and the map through all of them.
import { ask } from './ask.js';
import { button, draw, make } from './dom.js';
import { Drawing } from './drawing.js';
import { History } from './history.js';
import { foldedOf } from './mesh.js';
import { Overlay } from './overlay.js';
import { PairFiles } from './pair_files.js';
import { WAITING, badgesOf, cardOf, rowsOf } from './pair_report.js';
import { openingPairs } from './pair_sample.js';
import { pairSide } from './pair_side.js';
import { HINTS, OTHER, TOOLS } from './pair_tools.js';
import { Panel } from './panel.js';
import { watchPointer } from './pointer.js';

const ROUND = 0.15;            // of the picture, around it: transparent, for triangles that reach beyond it
const ASIDE = 9;               // pixels of the screen from a point to its number

const frameOf = ({ width: w, height: h }) => ({ kind: 'outline', points: [[0, 0], [w, 0], [w, h], [0, h]] });
const canvas = (width, height) => Object.assign(document.createElement('canvas'), { width, height });

/** A sheet with nothing on it but a lattice. */
function emptySheet({ width, height }) {
  const sheet = canvas(width, height), g = sheet.getContext('2d'), step = Math.max(width, height) / 16;
  Object.assign(g, { fillStyle: '#fbfbf8', strokeStyle: '#dcdcd4', lineWidth: step / 32 });
  g.fillRect(0, 0, width, height);
  for (let k = 1; k * step < Math.max(width, height); ++k) g.stroke(new Path2D(`M${k * step} 0V${height}M0 ${k * step}H${width}`));
  return sheet;
}

export class PairMode {
  view = { compare: true };
  images = { before: null, after: null };
  /** What a test looks at. */
  stats = { frames: 0, uncertified: 0, folded: 0, other: 0, refused: 0, times: [] };
  #remote; #say; #changed; #history = null; #live = null; #mesh = null; #error = null; #tool = 'move'; #pending = null; #round = 0;
  #drawings; #buttons; #clear;

  constructor(remote, { say, changed }) {
    [this.#remote, this.#say, this.#changed] = [remote, say, changed];
    const titles = { before: 'Before', after: 'After', result: 'Before, mapped', other: 'Thin-plate spline' };
    for (const [key, title] of Object.entries(titles)) this[key] = new Panel(title);
    this.after.wait('Drag point 4 to the town D');
    const acts = (side) => ({ grab: (h) => this.#grab(h), drag: (h, by) => this.#drag(side, h, by), drop: () => this.#drop(), remove: (h) => this.#remove(h) });
    this.overlays = { before: new Overlay(this.before, acts('points')), after: new Overlay(this.after, acts('targets')) };
    this.#drawings = ['before', 'after'].map((side) => new Drawing(this[side], this.overlays[side]));
    this.#clear = watchPointer(this, this.#drawings, remote, 'points.points');
    this.files = new PairFiles(this, remote, say);
    this.side = pairSide(this, this.files);
    this.#buttons = Object.entries(TOOLS).map(([key, [text, path]]) =>
      button(text, path, () => this.tool(key), { 'data-tool': key, 'aria-pressed': String(key === 'move') }));
    this.element = make('div', { class: 'mode points' },
      make('div', { class: 'tools', role: 'toolbar', 'aria-label': 'Tools' }, ...this.#buttons),
      make('div', { class: 'panels four' }, ...Object.keys(titles).map((key) => this[key].element)), this.side.element);
  }

  enter() {
    if (this.#history) return;
    const { before, after, points, targets } = openingPairs();
    this.#show('before', before);
    this.#show('after', after);
    this.#begin({ points, targets });
  }

  get #now() { return this.#history.now; }
  get canUndo() { return this.#history?.canUndo ?? false; }
  get canRedo() { return this.#history?.canRedo ?? false; }
  undo() { if (this.canUndo) this.#go(this.#history.undo()); }
  redo() { if (this.canRedo) this.#go(this.#history.redo()); }
  get state() { return this.#now; }
  get mesh() { return this.#mesh; }

  /* -------------------------------------------------------------- the document */

  /** A picture of the user's own. On the left, it comes with an empty sheet on the right. */
  open(side, image) {
    this.#show(side, image);
    if (side === 'before') { this.empty(); return; }
    this.#begin({ points: [], targets: [] });
    this.tool('pair');
  }

  /** An empty sheet on the right, of the size of the picture on the left. */
  empty() {
    this.#show('after', emptySheet(this.images.before));
    this.#begin({ points: [], targets: [] });
    this.tool('pair');
  }

  #show(side, image) {
    this.images[side] = image;
    const { points: corners } = frameOf(image), at = Float64Array.from(corners.flat());
    this[side].picture(image);
    this[side].show({ at, from: at, triangles: Uint32Array.of(0, 1, 2, 0, 2, 3) }, { look: 'picture' });
    if (side === 'before') this.#pad(image);
    else for (const panel of [this.result, this.other]) panel.look(this.after.box);
  }

  /** The picture with a transparent rim, for the panels that show it mapped. */
  #pad(image) {
    const { width, height } = image, r = this.#round = Math.ceil(ROUND * Math.max(width, height)), sheet = canvas(width + 2 * r, height + 2 * r);
    sheet.getContext('2d').drawImage(image, r, r);
    for (const panel of [this.result, this.other]) panel.picture(sheet);
  }

  #begin({ points, targets }) {
    this.#mesh = null;
    this.#history = new History({ points, targets, tolerance: 0 });
    for (const panel of [this.result, this.other]) panel.look(this.after.box);
    this.#go(this.#now);
  }

  /** A new state. It stays even if there is no map of it: the card says why, and what is wrong can be put right. */
  edit(change) { this.#go(this.#history.push({ ...this.#now, ...change })); }

  #go(state) {
    this.#live = state;
    this.side.tolerance.set(state.tolerance);
    this.#changed();
    this.#ask('points.make');
  }

  /* -------------------------------------------------------------- the map */

  #ask(operation) {
    const { points, targets, tolerance } = this.#live, { width, height } = this.images.before;
    if (points.length === 0) { this.#mesh = this.#error = null; this.render(); return; }
    this.#showPoints();
    ask(this.#remote, 'points', operation, { points, targets, tolerance, size: [width, height], compare: this.view.compare }, (result) => this.#take(result));
  }

  #take(result) {
    this.#error = result.error ?? null;
    if (result.error) ++this.stats.refused;
    else this.#count(this.#mesh = { ...result, folded: foldedOf(result.vertices, result.images, result.triangles),
      otherFolded: result.other ? foldedOf(result.vertices, result.other, result.triangles) : null });
    this.render();
  }

  #count({ certified, folded, otherFolded, ms }) {
    const s = this.stats;
    ++s.frames;
    s.uncertified += certified ? 0 : 1;
    s.folded += folded.length / 3;
    s.other = (otherFolded?.length ?? 0) / 3;
    s.times.push(ms);
  }

  setView(change) {
    Object.assign(this.view, change);
    this.#ask('points.make');
  }

  /* -------------------------------------------------------------- what is seen */

  render() {
    const mesh = this.#mesh;
    this.other.element.hidden = !this.view.compare;
    const from = mesh?.vertices.map((v) => v + this.#round), nothing = new Uint32Array(0), none = new Float64Array(0);
    const shown = (at, folded) => (at ? { at, from, triangles: mesh.triangles, folded } : { at: none, from: none, triangles: nothing });
    this.result.show(shown(mesh?.images), { look: 'picture' });
    this.other.show(shown(mesh?.other, mesh?.otherFolded), { look: 'picture' });
    this.#showPoints();
    this.#report(mesh);
  }

  #report(mesh) {
    this.side.card.set(mesh || this.#error ? cardOf(mesh, this.#error) : WAITING);
    const badges = mesh ? badgesOf(mesh, this.#error) : [['', ''], ['', '']];
    [this.result, this.other].forEach(({ badge }, k) => { [badge.dataset.state, badge.textContent] = badges[k]; });
    this.side.command(this.images.before);
    this.side.rows.replaceChildren(...(mesh ? rowsOf(mesh, (i) => this.overlays.after.focus(i + 1, 0)) : []));
  }

  /** The points with their numbers. On the right, a line leads from each to where the others would take it. */
  #showPoints() {
    const { points, targets } = this.#live, apart = this.#mesh?.apart;
    for (const [side, places] of [['before', points], ['after', targets]]) {
      const dots = places.map((p, i) => ({ kind: 'point', points: [p], name: `point ${i + 1}` }));
      const others = side === 'before' ? [] : places.map(([x, y], i) => {
        const [u, v] = [apart?.[2 * i], apart?.[2 * i + 1]];
        return { kind: 'off', points: [[x, y], Number.isFinite(u) ? [x + u, y + v] : [x, y]] };
      });
      const labels = places.map(([x, y], i) => ({ text: `${i + 1}`, at: [x + ASIDE * this[side].unit, y], kind: 'plain' }));
      this.overlays[side].show([frameOf(this.images[side]), ...dots, ...others], { editable: 'points', labels });
    }
  }

  /* -------------------------------------------------------------- the points */

  #grab(handle) {
    this.#clear();
    if (this.#tool !== 'remove') return true;
    this.#remove(handle);
    return false;
  }

  #drag(list, { part }, by) {
    const moved = this.#live[list].map((p, i) => (i === part - 1 ? [p[0] + by[0], p[1] + by[1]] : p));
    this.#live = { ...this.#live, [list]: moved };
    this.#ask(list === 'targets' ? 'points.move' : 'points.make');
  }

  #drop() {
    const { points, targets } = this.#live;
    if (points !== this.#now.points || targets !== this.#now.targets) this.edit({ points, targets });
  }

  #remove({ part }) {
    const without = (list) => list.filter((_, i) => i !== part - 1);
    this.edit({ points: without(this.#now.points), targets: without(this.#now.targets) });
  }

  /* -------------------------------------------------------------- tools */

  tool(key) {
    this.#tool = key;
    this.#pending = null;
    for (const b of this.#buttons) b.setAttribute('aria-pressed', b.dataset.tool === key);
    for (const d of this.#drawings) d.end();
    if (key === 'pair') this.#wait();
    this.#say(HINTS[key] ?? '');
  }

  /** Waits for a place on either side. `pending`, if there is one, is the place of a pair whose other one is not yet clicked. */
  #wait() {
    ['before', 'after'].forEach((side, k) => this.#drawings[k].begin('point', ([p]) => this.#clicked(side, p)));
  }

  #clicked(side, at) {
    const first = this.#pending?.side !== side ? this.#pending : null;
    if (!first) {
      this.#pending = { side, at };
      this.overlays[side].mark(draw('circle', { class: 'spot', cx: at[0], cy: at[1], r: 6 * this[side].unit }));
      this.#say(OTHER[side === 'before' ? 'after' : 'before']);
      return;
    }
    this.#pending = null;
    const places = { [first.side]: first.at, [side]: at };
    this.edit({ points: [...this.#now.points, places.before], targets: [...this.#now.targets, places.after] });
    for (const overlay of Object.values(this.overlays)) overlay.mark();
  }

  /** A file that was dropped or pasted. */
  take(file) { return this.files.take(file); }
}
