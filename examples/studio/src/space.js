// Mode space: a bar and the same bar bent, filled with tetrahedra, cut open.
import { ask } from './ask.js';
import { button, choice, make, section, slider } from './dom.js';
import { certificateCard } from './cage_side.js';
import { Renderer3 } from './gl3.js';
import { History } from './history.js';
import { bar, deform, sliced, turnedOver } from './solid.js';

const OUTSIDE = [0.55, 0.65, 0.74, 0.6], OPENED = [0.93, 0.62, 0.30, 1];
const HALF = { 0: 1.51, 1: 0.51, 2: 0.51 };
const TURN = 0.008, KEY_TURN = 0.12;

/** A panel that is looked at from all sides: drag, or arrow keys, and + and -. */
class View3 {
  constructor(title, look, changed) {
    this.canvas = make('canvas', { tabindex: 0, role: 'img', 'aria-label': `${title}: drag or use the arrow keys to look from another side` });
    this.badge = make('output', { class: 'badge' });
    this.hint = make('p', { class: 'waits' }, title === 'After' ? 'Drag to look from another side' : '');
    const stage = make('div', { class: 'stage' }, this.canvas, this.hint);
    this.element = make('figure', { class: 'panel' }, make('figcaption', {}, make('strong', {}, title), make('span', { class: 'note' }), this.badge), stage);
    this.renderer = new Renderer3(this.canvas);
    new ResizeObserver(changed).observe(stage);
    const turn = (dx, dy) => {
      look.turn += dx;
      look.tilt = Math.max(-1.5, Math.min(1.5, look.tilt + dy));
      changed();
    };
    this.canvas.addEventListener('pointerdown', (e) => { this.hint.textContent = ''; this.canvas.setPointerCapture(e.pointerId); });
    this.canvas.addEventListener('pointermove', (e) => { if (e.buttons) turn(-e.movementX * TURN, e.movementY * TURN); });
    this.canvas.addEventListener('wheel', (e) => { e.preventDefault(); look.distance *= e.deltaY > 0 ? 1.08 : 0.93; changed(); }, { passive: false });
    this.canvas.addEventListener('keydown', (e) => {
      const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[e.key];
      if (by) turn(by[0] * KEY_TURN, by[1] * KEY_TURN);
      else if (e.key === '+' || e.key === '-') { look.distance *= e.key === '-' ? 1.1 : 0.9; changed(); } else return;
      e.preventDefault();
    });
  }
}

export class SpaceMode {
  stats = { frames: 0, uncertified: 0, turned: 0, times: [] };
  #remote; #changed; #bar = bar(); #solid = null; #trouble = null; #axis = 1; #cut = 0; #history; #live; #sliders;
  #look = { turn: 0.6, tilt: -0.6, distance: 5 };

  constructor(remote, { changed }) {
    [this.#remote, this.#changed] = [remote, changed];
    this.before = new View3('Before', this.#look, () => this.#draw());
    this.after = new View3('After', this.#look, () => this.#draw());
    this.after.element.classList.add('first');
    this.card = certificateCard();
    this.#live = { bend: 1.6, twist: 0, waist: 0 };
    this.#history = new History(this.#live);
    const degrees = (v) => `${Math.round((v * 180) / Math.PI)}°`;
    const control = (label, key, options) => {
      const row = slider(label, { value: this.#live[key], ...options }, (v) => this.#set({ [key]: v }));
      row.input.addEventListener('change', () => { this.#history.push(this.#live); this.#changed(); });
      return row;
    };
    this.#sliders = { bend: control('Bend', 'bend', { min: -4.2, max: 4.2, step: 0.05, text: degrees }),
      twist: control('Twist', 'twist', { min: -3, max: 3, step: 0.05, text: degrees }),
      waist: control('Waist', 'waist', { min: 0, max: 0.7, step: 0.01, text: (v) => `${Math.round(100 * v)} %` }) };
    const cut = slider('Cut at', { min: -1, max: 1, step: 0.02, value: 0, text: (v) => v.toFixed(2) }, (v) => { this.#cut = v; this.#fill(); });
    this.element = make('div', { class: 'mode space' }, make('div', { class: 'panels two' }, this.after.element, this.before.element),
      make('aside', { 'aria-label': 'Space' }, this.card, section('Bar', ...Object.values(this.#sliders),
        button('Straight again', null, () => this.reset(), { class: 'framed' })),
      choice('Cutting plane', 'axis', { 0: 'Across', 1: 'Along', 2: 'Flat' }, '1', (axis) => { this.#axis = Number(axis); this.#fill(); }), cut,
      make('p', { class: 'hint' }, 'Tetrahedra fill both surfaces, each positive before and after. The plane cuts the bar before it is bent, so that '
        + 'one sees where its inside goes. Drag to look from another side; the wheel, ', make('kbd', {}, '+'), ' and ', make('kbd', {}, '−'), ' come nearer.')));
  }

  get canUndo() { return this.#history.canUndo; }
  get canRedo() { return this.#history.canRedo; }
  undo() { this.#restore(this.#history.undo()); }
  redo() { this.#restore(this.#history.redo()); }
  reset() { this.#restore(this.#history.push({ bend: 0, twist: 0, waist: 0 })); }

  #restore(state) {
    for (const [key, row] of Object.entries(this.#sliders)) { row.input.value = state[key]; row.input.dispatchEvent(new Event('input')); }
    this.#live = state;
    this.#changed();
  }

  enter() { if (!this.#solid) this.#ask('space.create'); else this.#fill(); }
  render() { this.#draw(); }

  #set(change) {
    this.#live = { ...this.#live, ...change };
    this.#ask(this.#solid ? 'space.follow' : 'space.create');
  }

  #ask(operation) {
    const { points, facets } = this.#bar;
    ask(this.#remote, 'space', operation, { points, facets, target: deform(points, this.#live) }, (result) => {
      this.#trouble = result.error ?? null;
      if (!result.error) {
        this.#solid = result;
        ++this.stats.frames;
        this.stats.uncertified += result.certified ? 0 : 1;
        this.stats.turned += result.turned = turnedOver(result);
        this.stats.times.push(result.ms);
      }
      this.#fill();
    });
  }

  #fill() {
    this.#show();
    if (!this.#solid) return;
    const { before, after, corners, opened } = sliced(this.#solid, this.#axis, this.#cut * HALF[this.#axis]);
    const tones = Float32Array.from({ length: opened.length * 12 }, (_, i) => (opened[Math.floor(i / 12)] ? OPENED : OUTSIDE)[i % 4]);
    this.before.renderer.triangles(before, corners, tones);
    this.after.renderer.triangles(after, corners, tones);
    this.#draw();
  }

  #show() {
    const solid = this.#solid, { badge } = this.after;
    if (this.#trouble) {
      this.card.set({ state: 'bad', title: 'No map to here', lines: [`${this.#trouble.message}.`, ...(solid ? ['The last good one stays.'] : [])] });
      [badge.dataset.state, badge.textContent] = ['bad', 'refused'];
    } else if (solid) {
      this.card.set({ state: solid.certified ? 'good' : 'bad', title: solid.certified ? 'Certified one-to-one' : 'Not certified',
        lines: [`${solid.nSimplices.toLocaleString('en')} tetrahedra, ${solid.turned} turned over`, `mean distortion ${(solid.energy / 6).toFixed(2)} (1 is rigid), made in ${solid.ms.toFixed(0)} ms`] });
      [badge.dataset.state, badge.textContent] = solid.certified ? ['good', 'certified'] : ['bad', 'not certified'];
    } else this.card.set({ state: '', title: 'Filling the bar …' });
  }

  #draw() {
    this.before.renderer.draw(this.#look);
    this.after.renderer.draw({ ...this.#look, centre: [0, this.#live.bend / 4, 0] });
  }
}
