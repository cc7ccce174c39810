// Mode pins: a figure, pins in it, and the map that follows the pins as they are dragged. The outline is free.
import { ask } from './ask.js';
import { cutoutOf } from './cutout.js';
import { button, make } from './dom.js';
import { Drawing } from './drawing.js';
import { History } from './history.js';
import { foldedOf, rimsOf } from './mesh.js';
import { Overlay } from './overlay.js';
import { Panel } from './panel.js';
import { PinFiles } from './pin_files.js';
import { FIGURES } from './pin_figures.js';
import { labelsOf, reportOf } from './pin_report.js';
import { pinSide } from './pin_side.js';
import { HINTS, TOOLS } from './pin_tools.js';
import { watchPointer } from './pointer.js';
import { restOf } from './pose.js';
import { SAMPLES } from './samples.js';
import { outlineOf, withPart } from './shape.js';

const ASIDE = 30;              // pixels of the screen from a pin that is not reached to the words beside it
const FAINT = { light: [0.91, 0.91, 0.89, 0.72], dark: [0.07, 0.075, 0.08, 0.72] };

const frameOf = ({ width: w, height: h }) => outlineOf([[0, 0], [w, 0], [w, h], [0, h]]);

export class PinMode {
  view = { look: 'picture', mesh: false };
  /** What a test looks at. */
  stats = { frames: 0, uncertified: 0, folded: 0, refused: 0, times: [] };
  #remote; #say; #changed; #modes; #history = null; #live = null; #mesh = null; #error = null; #number = 0; #image; #tool = 'move';
  #drawings; #buttons; #clear;

  constructor(remote, { say, changed, modes }) {
    [this.#remote, this.#say, this.#changed, this.#modes] = [remote, say, changed, modes];
    this.after = new Panel('Pose');
    this.before = new Panel('At rest');
    this.after.element.classList.add('first');
    this.after.wait('Drag a yellow pin');
    const acts = { grab: (h) => this.#grab(h), remove: (h) => this.#remove(h), drop: () => this.#drop() };
    this.overlays = {
      after: new Overlay(this.after, { ...acts, drag: (h, by) => this.#drag(h, by) }),
      before: new Overlay(this.before, { ...acts, drag: () => {} }),
    };
    this.#drawings = [new Drawing(this.after, this.overlays.after), new Drawing(this.before, this.overlays.before)];
    this.#clear = watchPointer(this, this.#drawings, remote, 'pins.points');
    this.files = new PinFiles(this, remote, say);
    this.side = pinSide(this, this.files);
    this.#buttons = Object.entries(TOOLS).map(([key, [text, path]]) =>
      button(text, path, () => this.tool(key), { 'data-tool': key, 'aria-pressed': String(key === 'move') }));
    this.element = make('div', { class: 'mode pins' },
      make('div', { class: 'tools', role: 'toolbar', 'aria-label': 'Tools' }, ...this.#buttons),
      make('div', { class: 'panels wide' }, this.after.element, this.before.element), this.side.element);
  }

  enter() { if (!this.#history) this.figure('figure'); }

  get #now() { return this.#history.now; }
  get canUndo() { return this.#history?.canUndo ?? false; }
  get canRedo() { return this.#history?.canRedo ?? false; }
  undo() { if (this.canUndo) this.#go(this.#history.undo(), 'pins.recall'); }
  redo() { if (this.canRedo) this.#go(this.#history.redo(), 'pins.recall'); }
  get state() { return this.#now; }
  get mesh() { return this.#mesh; }
  get image() { return this.#image; }

  /* -------------------------------------------------------------- the document */

  /** A figure to begin with: one of FIGURES, the cage of mode cage, or the frame of the picture. */
  figure(key) {
    const { cage } = this.#modes, image = key === 'cage' ? cage.image : this.#image;
    if (key in FIGURES) {
      const { sample, figure, pins, targets } = FIGURES[key][1];
      this.#picture(SAMPLES[sample][1]());
      this.begin(figure, pins, targets);
    } else {
      this.#picture(image);
      this.begin(key === 'cage' ? cage.shapes.source.filter(({ kind }) => kind === 'outline' || kind === 'hole') : frameOf(image));
    }
    this.side.select.value = key;
  }

  /** A picture of the user's own. The figure is what is not transparent, or else the frame, until another one is drawn. */
  open(image) {
    const cutout = cutoutOf(image);
    this.#picture(image);
    this.begin(cutout ?? frameOf(image));
    if (!cutout) this.side.select.value = 'frame';
  }

  #picture(image) {
    this.#image = image;
    for (const panel of [this.after, this.before]) panel.picture(image);
  }

  /** Another figure. What was there before cannot be had back by undo. */
  begin(figure, pins = [], targets = pins) {
    this.side.select.value = '';
    this.#mesh = null;
    this.#history = new History({ figure, pins, targets, reach: 0, number: ++this.#number });
    this.side.reach.set(0);
    this.#go(this.#now, 'pins.make');
    this.tool(pins.length > 0 ? 'move' : 'point');
  }

  /** A new state. It is forgotten if there is no map of it, and what was before it stays. */
  #push(change, operation = 'pins.make') {
    const state = this.#history.push({ ...this.#now, ...change, number: ++this.#number });
    this.#go(state, operation, () => {
      if (state !== this.#now) return;
      this.#live = this.#history.withdraw();
      this.side.reach.set(this.#live.reach);
      this.#changed();
    });
  }

  #go(state, operation, refused = () => {}) {
    this.#live = state;
    this.side.reach.set(state.reach);
    this.#changed();
    ask(this.#remote, 'pins', operation, state, (result) => {
      if (result.error) refused();
      this.#take(result);
      if (result.error) this.#say(`${result.error.message}.`);
    });
  }

  /* -------------------------------------------------------------- the map */

  #take(result) {
    this.#error = result.error ?? null;
    if (result.error) ++this.stats.refused;
    else {
      const folded = foldedOf(result.vertices, result.images, result.triangles), s = this.stats;
      this.#mesh = { ...result, folded };
      ++s.frames;
      s.uncertified += result.certified ? 0 : 1;
      s.folded += folded.length / 3;
      s.times.push(result.ms);
    }
    this.render();
  }

  setView(change) {
    Object.assign(this.view, change);
    this.render();
  }

  /* -------------------------------------------------------------- what is seen */

  render() {
    const mesh = this.#mesh, { look, mesh: lines } = this.view;
    if (!mesh) return;
    const { vertices: from, images, triangles } = mesh;
    const whole = FAINT[matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light'];
    this.before.show({ at: from, from, triangles }, { look: look === 'heat' ? 'picture' : look, mesh: lines, whole });
    this.after.show({ at: images, from, triangles }, { look, mesh: lines });
    this.#showPins();
    const { card, badge } = reportOf(mesh, this.#error);
    this.side.card.set(card);
    [this.after.badge.dataset.state, this.after.badge.textContent] = badge;
  }

  /** The outline as the map has it, the pins, and a line from each pin that is not reached to its place. */
  #showPins() {
    const { figure, pins, targets } = this.#live, mesh = this.#mesh;
    const dots = (at) => at.map((p, i) => ({ kind: 'point', points: [p], name: `pin ${i + 1}` }));
    const rims = rimsOf(mesh).map((points) => ({ kind: 'outline', points }));
    const off = targets.slice(0, mesh.distances.length).map(([x, y], i) => ({ kind: 'off', points:
      mesh.distances[i] > 0 ? [[x + mesh.off[2 * i], y + mesh.off[2 * i + 1]], [x, y]] : [[x, y], [x, y]] }));
    this.overlays.after.show([...rims, ...dots(targets), ...off],
      { editable: 'points', labels: labelsOf(mesh, targets, ASIDE * this.after.unit) });
    this.overlays.before.show([...figure, ...dots(pins)], { editable: 'points' });
  }

  /* -------------------------------------------------------------- the pins */

  #pinOf({ part }) { return part - this.#live.figure.length; }

  #grab(handle) {
    if (this.#tool === 'remove') { this.#remove(handle); return false; }
    this.#clear();
    return handle.element.closest('svg') === this.after.svg;
  }

  #drag(handle, by) {
    const k = this.#pinOf(handle), { targets } = this.#live;
    this.#live = { ...this.#live, targets: targets.map((p, i) => (i === k ? [p[0] + by[0], p[1] + by[1]] : p)) };
    this.#showPins();
    ask(this.#remote, 'pins', 'pins.move', { ...this.#live, number: undefined }, (result) => this.#take(result));
  }

  #drop() {
    const { targets } = this.#live;
    if (targets !== this.#now.targets) this.#push({ targets }, 'pins.move');
  }

  reset() { this.#push({ targets: this.#now.pins }); }
  reach(reach) { if (this.#now.pins.length > 0) this.#push({ reach }); }

  #remove(handle) {
    const k = this.#pinOf(handle), without = (list) => list.filter((_, i) => i !== k);
    this.#push({ pins: without(this.#now.pins), targets: without(this.#now.targets) });
  }

  /** A pin where the picture was clicked. In the pose, it holds the place that it has there. */
  #add(at, posed) {
    const p = posed ? restOf(this.#mesh, at) : at;
    if (!p) { this.#say('A pin lies in the figure.'); return; }
    const { pins, targets } = this.#now;
    this.#push({ pins: [...pins, p], targets: [...targets, posed ? at : this.#imageOf(p)] });
  }

  /** Where the map takes a place at rest, so that a new pin moves nothing. */
  #imageOf(p) {
    const { vertices, images } = this.#mesh;
    return restOf({ ...this.#mesh, vertices: images, images: vertices }, p) ?? p;
  }

  /* -------------------------------------------------------------- tools */

  /** Adding pins goes on until another tool is chosen. */
  tool(key) {
    this.#tool = key;
    for (const b of this.#buttons) b.setAttribute('aria-pressed', b.dataset.tool === key);
    for (const d of this.#drawings) d.end();
    if (key === 'point') this.#drawings.forEach((d, k) => d.begin('point', ([p]) => this.#add(p, k === 0)));
    if (key === 'outline' || key === 'hole') this.#drawings[1].begin(key, (points) => this.#drawn(key, points));
    this.#say(HINTS[key] ?? '');
  }

  #drawn(kind, points) {
    if (kind === 'outline') { this.begin(outlineOf(points)); return; }
    this.tool('move');
    this.#push({ figure: withPart(this.#now.figure, { kind, points }) });
  }

  /** A file that was dropped or pasted. */
  take(file) { return this.files.take(file); }
}
