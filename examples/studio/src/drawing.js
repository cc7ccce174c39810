// Drawing a new part on a panel: by clicks, or with the keys (arrows, Enter, Escape).
import { draw } from './dom.js';
import { CLOSED, LEAST } from './shape.js';

const CLOSE = 13;              // pixels from the first place within which a click closes a ring
const STEP = 6, LEAP = 30;     // pixels that an arrow moves the cursor
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** One at a time: `begin(kind, done)` until it is done or given up. */
export class Drawing {
  #panel; #overlay; #points = []; #kind = null; #done; #cursor = null;

  constructor(panel, overlay) {
    this.#panel = panel;
    this.#overlay = overlay;
    const { svg } = panel;
    svg.addEventListener('pointerdown', (e) => this.#down(e));
    svg.addEventListener('pointermove', (e) => { if (this.#kind) { this.#cursor = panel.at(e); this.#show(); } });
    svg.addEventListener('dblclick', () => this.finish());
    svg.addEventListener('keydown', (e) => this.#key(e));
  }

  get active() { return this.#kind !== null; }

  begin(kind, done) {
    this.#kind = kind;
    this.#done = done;
    this.#points = [];
    this.#cursor = null;
    this.#panel.svg.classList.add('drawing');
    this.#panel.svg.setAttribute('tabindex', '0');
  }

  end() {
    this.#kind = null;
    this.#points = [];
    this.#panel.svg.classList.remove('drawing');
    this.#panel.svg.removeAttribute('tabindex');
    this.#overlay.mark();
  }

  /** Takes what has been drawn, if it is enough. */
  finish() {
    if (!this.#kind || this.#points.length < LEAST[this.#kind]) return;
    const points = this.#points;
    this.#points = [];
    this.#overlay.mark();
    this.#done(points);
  }

  #down(event) {
    if (!this.#kind || event.button > 0) return;
    event.preventDefault();
    this.#put(this.#panel.at(event));
  }

  #put(at) {
    const near = ([x, y]) => Math.hypot(x - at[0], y - at[1]) < CLOSE * this.#panel.unit;
    const n = this.#points.length;
    if (n > 0 && CLOSED[this.#kind] && near(this.#points[0])) return this.finish();
    if (n > 0 && near(this.#points.at(-1))) return this.finish();
    this.#points.push(at);
    if (this.#kind === 'point') return this.finish();
    return this.#show();
  }

  #key(event) {
    if (!this.#kind) return;
    const by = ARROWS[event.key], { box, unit } = this.#panel;
    this.#cursor ??= [box[0] + box[2] / 2, box[1] + box[3] / 2];
    if (by) this.#cursor = this.#cursor.map((v, k) => v + by[k] * (event.shiftKey ? LEAP : STEP) * unit);
    else if (event.key === 'Enter' || event.key === ' ') this.#put(this.#cursor);
    else if (event.key === 'Backspace') this.#points.pop();
    else return;
    event.preventDefault();
    this.#show();
  }

  #show() {
    if (!this.#kind) return;
    const all = [...this.#points, ...(this.#cursor ? [this.#cursor] : [])], u = this.#panel.unit;
    this.#overlay.mark(
      draw('path', { class: 'part draft', d: all.length > 1 ? `M${all.map((p) => p.join()).join('L')}` : '' }),
      ...this.#points.map(([cx, cy]) => draw('circle', { class: 'spot', cx, cy, r: 4 * u })),
      ...(this.#cursor ? [draw('circle', { class: 'spot', cx: this.#cursor[0], cy: this.#cursor[1], r: 3 * u })] : []));
  }
}
