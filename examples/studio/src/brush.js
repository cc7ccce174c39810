// A brush on a panel: strokes are collected while the pointer is down, and given when it is lifted.
import { draw } from './dom.js';

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

export class Brush {
  #panel; #overlay; #acts; #strokes = null; #at = null;
  radius = 60;

  /** acts: { stroke(at), done(strokes) }. */
  constructor(panel, overlay, acts) {
    this.#panel = panel;
    this.#overlay = overlay;
    this.#acts = acts;
    this.active = false;
    const { svg } = panel;
    svg.addEventListener('pointerdown', (event) => {
      if (!this.active || event.button > 0) return;
      event.preventDefault();
      svg.setPointerCapture(event.pointerId);
      this.#strokes = [];
      this.#dab(panel.at(event));
    });
    svg.addEventListener('pointermove', (event) => {
      if (!this.active) return;
      this.#at = panel.at(event);
      this.#show();
      const last = this.#strokes?.at(-1);
      if (last && Math.hypot(this.#at[0] - last[0], this.#at[1] - last[1]) > this.radius / 4) this.#dab(this.#at);
    });
    svg.addEventListener('pointerup', () => this.#done());
    svg.addEventListener('pointerleave', () => { if (this.active && !this.#strokes) overlay.mark(); });
    svg.addEventListener('keydown', (event) => this.#key(event));
  }

  set(active) {
    this.active = active;
    this.#panel.svg.classList.toggle('drawing', active);
    this.#panel.svg.toggleAttribute('tabindex', active);
    if (active) this.#panel.svg.setAttribute('tabindex', '0'); else this.#overlay.mark();
  }

  #dab(at) {
    this.#strokes.push(at);
    this.#acts.stroke(at);
  }

  #done() {
    const strokes = this.#strokes;
    this.#strokes = null;
    if (strokes?.length) this.#acts.done(strokes);
  }

  #key(event) {
    if (!this.active) return;
    const by = ARROWS[event.key], { box, unit } = this.#panel;
    this.#at ??= [box[0] + box[2] / 2, box[1] + box[3] / 2];
    if (by) this.#at = this.#at.map((v, k) => v + by[k] * (event.shiftKey ? 30 : 6) * unit);
    else if (event.key === 'Enter' || event.key === ' ') { this.#strokes = []; this.#dab(this.#at); this.#done(); }
    else return;
    event.preventDefault();
    this.#show();
  }

  #show() {
    const [cx, cy] = this.#at;
    this.#overlay.mark(draw('circle', { class: 'part casing', cx, cy, r: this.radius }),
      draw('circle', { class: 'part', cx, cy, r: this.radius }));
  }
}
