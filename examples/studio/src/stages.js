// Mode stages: the papers' Integral Curve Coordinates step by step, on the outline of mode cage.
import { ask } from './ask.js';
import { choice, make, section, slider } from './dom.js';
import { drawStep, grassfire, levelLines, levels } from './stage_draw.js';
import { Overlay } from './overlay.js';
import { Sheet } from './sheet.js';

const LEVELS = 24;
const STEPS = { grid: '1 Grid', fire: '2 Fire', tree: '3 Tree', function: '4 Function', levels: '5 Levels', curves: '6 Curves', walk: '7 Coordinates' };
const FUNCTIONS = { decay: 'Decay', distance: 'Distance', laplace: 'Harmonic', bilaplace: 'Biharmonic' };
const STEP = 6;
const WAIT_MS = 500;
const WAITING = 'The stages of this outline are being made. What was begun before, such as a map in mode Cage, is finished first.';
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** What a step does, with its numbers. */
const TEXTS = {
  grid: (d) => ['A regular grid covers the shape. A vertex belongs to it if it lies strictly inside.',
    { 'Grid vertices': d.grid.nVertices, Inside: d.grid.nInside }],
  fire: (d) => ['Fire starts all along the outline and burns one step a round. Where it arrives last is the maximum (Algorithm 1).',
    { 'Rounds before the maximum burns': d.rounds }],
  tree: (d) => ['From the maximum a tree grows along the axes in turn. Neighbours are parent and child, or cousins (Algorithm 2).',
    { 'Pairs of neighbours': d.report.nPairs, 'Pairs that break the cousin rule': d.report.nCousinViolations, 'Not reached': d.report.nUnreachable }],
  function: (d) => ['A function that falls from parent to child: it has one maximum and nothing else that is critical.',
    { Maxima: d.critical.nMaxima, Minima: d.critical.nMinima, Saddles: d.critical.nSaddles }],
  levels: () => ['Its level lines are rings around the maximum. Curves run across them, from the outline to the maximum.', {}],
  curves: (d) => ['Integral curves follow the function through points of the grid, up to the maximum and down to the outline.',
    { Curves: d.ends.all, 'Curves that end at the maximum': d.ends.maximum }],
  walk: (d) => ['Move over the shape: the curve through that place, and the place with the same coordinates in the other shape. '
    + 'At red edges curves merge on the way up (compression), at green ones on the way down (expansion): so this method is not one-to-one.',
  { Compression: d.kinds.filter((k) => k === 1).length, Expansion: d.kinds.filter((k) => k === 2).length,
    'Area not covered': `${(100 * d.chart.uncovered).toFixed(1)} %`, 'Coordinates that collapse': `${(100 * d.chart.collapsed).toFixed(1)} %` }],
};

export class StageMode {
  canUndo = false;
  canRedo = false;
  stats = { frames: 0 };
  #remote; #say; #cage; #step = 'grid'; #cells = 40; #kind = 'decay'; #data = null; #walk = null; #point = null; #shape; #waiting = 0;

  constructor(remote, { say, modes }) {
    [this.#remote, this.#say, this.#cage] = [remote, say, modes.cage];
    this.source = new Sheet('Before', { redraw: () => this.render() });
    this.target = new Sheet('After', { redraw: () => this.render() });
    this.source.element.classList.add('first');
    this.source.wait('Choose a step on the right');
    this.overlays = [this.source, this.target].map((sheet) => new Overlay(sheet, {}));
    this.text = make('p', { class: 'lesson', 'aria-live': 'polite' });
    this.facts = make('dl');
    this.#listen();
    this.element = make('div', { class: 'mode stages' }, make('div', { class: 'panels two' }, this.source.element, this.target.element),
      make('aside', { 'aria-label': 'Stages' },
        choice('Step', 'step', STEPS, this.#step, (step) => { this.#step = step; this.render(); }), section('What happens', this.text, this.facts),
        choice('Function', 'function', FUNCTIONS, this.#kind, (kind) => { this.#kind = kind; this.enter(); }),
        slider('Cells', { min: 10, max: 120, step: 2, value: 40 }, (cells) => { this.#cells = cells; this.enter(); }),
        make('p', { class: 'hint' }, 'The outline is that of mode Cage. L. Huynh, thesis, 2013; L. Huynh and Y. Gingold, Bijective Deformations '
          + 'in Rⁿ via Integral Curve Coordinates. The library’s default is another method, which is one-to-one.')));
  }

  undo() {}
  redo() {}

  #listen() {
    const { svg } = this.source;
    svg.setAttribute('tabindex', '0');
    svg.setAttribute('aria-label', 'Before: move a point with the arrow keys');
    svg.addEventListener('pointermove', (event) => this.#move(this.source.at(event)));
    svg.addEventListener('pointerdown', (event) => this.#move(this.source.at(event)));
    svg.addEventListener('keydown', (event) => {
      const by = ARROWS[event.key];
      if (!by || !this.#data) return;
      event.preventDefault();
      const { box } = this.source, at = this.#point ?? [box[0] + box[2] / 2, box[1] + box[3] / 2];
      this.#move(at.map((v, a) => v + by[a] * STEP));
    });
  }

  enter() {
    const { image, shapes: { source, target } } = this.#cage;
    this.#shape = [source[0].points, target[0].points];
    const m = 0.1 * Math.max(image.width, image.height);
    for (const sheet of [this.source, this.target]) sheet.look([-m, -m, image.width + 2 * m, image.height + 2 * m]);
    this.#walk = null;
    if (!this.#data) this.#tell('The stages of this outline are being made.');
    clearTimeout(this.#waiting);
    this.#waiting = setTimeout(() => this.#tell(WAITING), WAIT_MS);
    ask(this.#remote, 'stages', 'stages.make', { source: source[0].points, target: target[0].points, cells: this.#cells, kind: this.#kind },
      (result) => {
        clearTimeout(this.#waiting);
        if (result.error) { this.#refuse(result.error.message); return; }
        const burnt = grassfire(result.grid, result.inside), height = levels(result.values, result.inside);
        this.#data = { ...result, burnt, height, lines: levelLines(result.grid, height, LEVELS) };
        ++this.stats.frames;
        this.render();
      }).catch((error) => { clearTimeout(this.#waiting); this.#refuse(error.message); });
  }

  /** Without stages the outline is shown, and why; a message that goes would leave an empty page. */
  #refuse(why) {
    this.#data = this.#walk = this.#point = null;
    this.#tell(`There are no stages: ${why}. Drag the outline in mode Cage until both shapes are simple.`);
    for (const sheet of [this.source, this.target]) sheet.note.textContent = '';
    this.render();
  }

  #tell(text, facts = {}) {
    this.text.textContent = text;
    this.facts.replaceChildren(...Object.entries(facts).flatMap(([k, v]) => [make('dt', {}, k), make('dd', {}, String(v))]));
  }

  #move(point) {
    if (!this.#data) return;
    this.#point = point;
    ask(this.#remote, 'walk', 'stages.trace', { point }, (result) => {
      this.#walk = result.curve ? result : null;
      const to = result.image && !Number.isNaN(result.image[0]) ? result.image : null;
      this.source.note.textContent = result.curve ? `edge ${result.facet + 1}, ${((1 - result.share) * 100).toFixed(1)} % along it, t = ${result.t.toFixed(3)}` : '';
      this.target.note.textContent = result.curve ? (to ? 'the same coordinates' : 'no point has these coordinates') : '';
      this.render();
    });
  }

  render() {
    if (!this.#shape) return;
    const { image } = this.#cage, walk = this.#walk, to = walk?.image && !Number.isNaN(walk.image[0]) ? walk.image : null;
    drawStep(this.source, image, this.#data ? this.#step : null, this.#data, walk?.curve, walk && this.#point);
    drawStep(this.target, image, null, this.#data, walk?.there, to);
    this.#shape.forEach((points, k) => this.overlays[k].show([{ kind: 'outline', points }], { editable: false }));
    if (this.#data) this.#tell(...TEXTS[this.#step](this.#data));
  }
}
