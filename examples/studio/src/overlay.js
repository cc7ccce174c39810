// The handles of a shape on a panel: seen, dragged by mouse, touch and pen, moved by keys.
import { draw } from './dom.js';
import { CLOSED, centreOf, edgesOf } from './shape.js';

const TARGET = 13;             // pixels from a handle within which a touch is one on it: 26 across
const DOT = 5, SMALL = 3.2;
const MOST_EDGES = 60;         // vertices of a part, beyond which edges have no handles
const NUMBER = 17;             // pixels of the number of an edge
const ROOM = 56;               // pixels that an edge needs for one
const same = ([x, y], [u, v]) => x === u && y === v;
const TURN = 0.01;             // radians that a pixel turns
const STEP = Math.PI / 36;     // and a key
const NAMES = { outline: 'corner', hole: 'hole corner', line: 'line point', point: 'pin' };
const KEYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/**
 * acts: { grab(handle), drag(handle, by), turn(handle, angle), drop(handle), remove(handle), add(handle) },
 * where a handle is { type: 'vertex' | 'edge' | 'part' | 'all', part, vertices }. Handles turn by the right
 * button, with Shift, or by the keys , and . if there is turn().
 */
export class Overlay {
  #panel; #acts; #shape = null; #handles = []; #held = new Map(); #paths = []; #marks; #bad = new Set();
  #placed = null; #unit = 0; #labels = [];

  constructor(panel, acts) {
    this.#panel = panel;
    this.#acts = acts;
    this.#marks = draw('g', { class: 'marks' });
    this.lines = draw('g', { class: 'lines' });
    this.numbers = draw('g', { class: 'numbers' });
    this.grips = draw('g', { class: 'grips' });
    panel.svg.append(this.lines, this.#marks, this.grips, this.numbers);
    panel.resized = () => this.#place();
    const { svg } = panel;
    svg.addEventListener('pointerdown', (e) => this.#down(e));
    svg.addEventListener('pointermove', (e) => this.#move(e));
    for (const end of ['pointerup', 'pointercancel']) svg.addEventListener(end, (e) => this.#up(e));
    svg.addEventListener('keydown', (e) => this.#key(e));
    if (acts.turn) svg.addEventListener('contextmenu', (e) => e.preventDefault());
  }

  get busy() { return this.#held.size > 0; }

  /** Shows a shape, red edges, and words { text, at, kind }. Elements are made anew only when its make-up changes. */
  show(shape, { editable = true, bad = [], labels = [] } = {}) {
    const before = this.#shape;
    const alike = before && editable === this.editable && before.length === shape.length
      && before.every((part, k) => part.kind === shape[k].kind && part.points.length === shape[k].points.length);
    this.#shape = shape;
    this.editable = editable;
    this.#bad = new Set(bad);
    this.#labels = labels;
    if (!alike) this.#build();
    this.#place();
  }

  #build() {
    this.#placed = null;
    this.#paths = this.#shape.map(({ kind }) => ['casing', ''].map((more) => draw('path', { class: `part ${kind} ${more}` })));
    this.bad = draw('path', { class: 'part crossing' });
    this.lines.replaceChildren(...this.#paths.flat(), this.bad);
    this.#handles = [];
    const all = this.editable === true;
    this.#shape.forEach((part, k) => {
      if (all || (this.editable === 'points' && part.kind === 'point')) this.#buildPart(part, k);
      if (this.editable === 'points' && part.kind === 'bone')
        this.#grip({ type: 'edge', part: k, vertices: [0, 1] }, `bone ${part.name}`, 'edge');
    });
    if (all) this.#grip({ type: 'all', part: 0, vertices: null }, 'move everything', 'all');
    this.grips.replaceChildren(...this.#handles.map((handle) => handle.element));
  }

  #buildPart(part, k) {
    const n = part.points.length;
    if (n <= MOST_EDGES && part.kind !== 'point')
      for (const [i, j] of edgesOf(part))
        this.#grip({ type: 'edge', part: k, vertices: [i, j] }, `${part.kind} edge ${i + 1}`, 'edge');
    if (k > 0 && n > 1) this.#grip({ type: 'part', part: k, vertices: null }, `move ${part.kind} ${k}`, 'whole');
    part.points.forEach((_, i) => this.#grip({ type: 'vertex', part: k, vertices: [i] },
      part.name ?? `${NAMES[part.kind]} ${part.kind === 'point' ? k : i + 1}`, part.kind));
  }

  #grip(handle, label, kind) {
    const element = draw('g', {
      class: `grip ${kind}`, tabindex: 0, role: 'button', 'aria-label': label,
      'data-type': handle.type, 'data-part': handle.part, 'data-vertex': handle.vertices?.[0] ?? '',
    }, draw('circle', { class: 'reach' }), draw(kind === 'all' || kind === 'whole' ? 'path' : 'circle', { class: 'dot' }));
    handle.element = element;
    element.handle = handle;
    this.#handles.push(handle);
  }

  /** Puts everything where it is now; what has not changed since is left alone. */
  #place() {
    if (!this.#shape) return;
    const u = this.#panel.unit, all = u !== this.#unit || this.#placed === null;
    this.#shape.forEach((part, k) => {
      if (!all && this.#placed[k] === part) return;
      const { kind, points } = part;
      const d = points.length < 2 ? '' : `M${points.map((p) => p.join()).join('L')}${CLOSED[kind] ? 'Z' : ''}`;
      for (const path of this.#paths[k]) path.setAttribute('d', d);
    });
    this.#placeBad(u);
    for (const handle of this.#handles) {
      const part = this.#shape[handle.part], old = all ? undefined : this.#placed[handle.part];
      const still = old && (old === part || handle.vertices?.every((i) => same(old.points[i], part.points[i])));
      if (!still) this.#placeOne(handle, u);
    }
    this.#placed = this.#shape;
    this.#unit = u;
  }

  /** Edges that are in each other's way: red, with their numbers. And the labels. */
  #placeBad(u) {
    const outline = this.#shape[0].points, n = outline.length;
    const edges = [...this.#bad].filter((i) => i < n).map((i) => ({ name: String(i + 1), ends: [outline[i], outline[(i + 1) % n]] }));
    if (edges.length + this.#labels.length === 0 && !this.bad.getAttribute('d') && !this.numbers.firstChild) return;
    this.bad.setAttribute('d', edges.map(({ ends: [a, b] }) => `M${a.join()}L${b.join()}`).join(''));
    const words = [...edges.map(({ name, ends }) => ({ text: name, at: centreOf(ends) })), ...this.#labels];
    this.numbers.replaceChildren(...words.map(({ text, kind = '', at: [x, y] }) =>
      draw('text', { class: `number ${kind}`, x, y, 'font-size': NUMBER * u }, text)));
  }

  #placeOne(handle, u) {
    const { element, type, part, vertices } = handle, { points } = this.#shape[part];
    const ends = vertices?.map((i) => points[i]);
    const [x, y] = this.#centre(handle);
    const [reach, dot] = element.children;
    element.setAttribute('transform', `translate(${x} ${y}) scale(${u})`);
    reach.setAttribute('r', TARGET);
    if (type === 'vertex') dot.setAttribute('r', points.length > MOST_EDGES ? SMALL : DOT);
    if (type === 'edge') {
      dot.setAttribute('r', SMALL);
      const room = Math.hypot(ends[0][0] - ends[1][0], ends[0][1] - ends[1][1]) / u > ROOM;
      element.toggleAttribute('data-tight', !room);
    }
    if (type === 'part' || type === 'all') dot.setAttribute('d', 'M-7 0H7M0-7V7M-4-4l-3 4 3 4M4-4l3 4-3 4M-4-4l4-3 4 3M-4 4l4 3 4-3');
  }

  #centre({ type, part, vertices }) {
    const { points } = this.#shape[part];
    if (type === 'vertex') return points[vertices[0]];
    if (type === 'edge') return centreOf(vertices.map((i) => points[i]));
    return centreOf(points);
  }

  #down(event) {
    const handle = event.target.closest?.('.grip')?.handle;
    if (!handle || (event.button > 0 && !this.#acts.turn)) return;
    event.preventDefault();
    handle.element.focus({ preventScroll: true });
    this.#panel.svg.setPointerCapture(event.pointerId);
    if (this.#acts.grab?.(handle, event) === false) return;
    handle.element.classList.add('held');
    const turning = this.#acts.turn && (event.button === 2 || event.shiftKey || event.altKey);
    this.#held.set(event.pointerId, { handle, turning, at: this.#panel.at(event) });
  }

  #move(event) {
    const held = this.#held.get(event.pointerId);
    if (!held) return;
    const [left, top, width, height] = this.#panel.box, [x, y] = this.#panel.at(event);
    const at = [Math.min(left + width, Math.max(left, x)), Math.min(top + height, Math.max(top, y))];
    const by = [at[0] - held.at[0], at[1] - held.at[1]];
    if (held.turning) this.#acts.turn(held.handle, (by[0] / this.#panel.unit) * TURN);
    else this.#acts.drag(held.handle, by);
    held.at = at;
  }

  #up(event) {
    const held = this.#held.get(event.pointerId);
    if (!held) return;
    this.#held.delete(event.pointerId);
    held.handle.element.classList.remove('held');
    this.#acts.drop(held.handle);
  }

  #key(event) {
    const handle = event.target.closest?.('.grip')?.handle, by = KEYS[event.key];
    if (!handle || event.ctrlKey || event.metaKey || event.altKey) return;
    if (by) {
      const step = (event.shiftKey ? 10 : 1) * Math.max(1, this.#panel.unit);
      this.#acts.drag(handle, by.map((v) => v * step));
      this.#acts.drop(handle);
    } else if (this.#acts.turn && (event.key === ',' || event.key === '.')) {
      this.#acts.turn(handle, (event.key === '.' ? 1 : -1) * STEP);
      this.#acts.drop(handle);
    } else if (event.key === 'Delete' || event.key === 'Backspace') this.#acts.remove?.(handle);
    else if (event.key === '+' || event.key === 'Insert' || (event.key === 'Enter' && handle.type === 'edge')) this.#acts.add?.(handle);
    else return;
    event.preventDefault();
  }

  /** Marks the handle of a part as the chosen one. */
  choose(part) { for (const { element, part: k, type } of this.#handles) element.classList.toggle('chosen', type === 'vertex' && k === part); }

  focus(part, vertex) { this.grips.querySelector(`[data-type=vertex][data-part="${part}"][data-vertex="${vertex}"]`)?.focus(); }

  /** Something drawn on top: a dot under the pointer, a line that is being drawn. */
  mark(...elements) { this.#marks.replaceChildren(...elements); }
}

