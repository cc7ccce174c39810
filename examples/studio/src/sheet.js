// A canvas with a drawing of handles on it, in the same coordinates of the plane.
import { draw, make } from './dom.js';

export class Sheet {
  /** redraw: called when the size has changed. */
  constructor(title, { role = 'group', redraw = () => {} } = {}) {
    this.canvas = make('canvas', { 'aria-hidden': 'true' });
    this.svg = draw('svg', { class: 'overlay', role, 'aria-label': title });
    this.note = make('span', { class: 'note' });
    this.caption = make('figcaption', {}, make('strong', {}, title), this.note);
    this.hint = make('p', { class: 'waits' });
    const stage = make('div', { class: 'stage' }, this.canvas, this.svg, this.hint);
    this.element = make('figure', { class: 'panel' }, this.caption, stage);
    this.box = [0, 0, 1, 1];
    new ResizeObserver(() => { redraw(); this.resized?.(); }).observe(stage);
  }

  /** Says on the picture what it waits for, until the first touch. */
  wait(text) {
    this.hint.textContent = text;
    this.svg.addEventListener('pointerdown', () => { this.hint.textContent = ''; }, { once: true });
  }

  /** What of the plane is seen. */
  look(box) {
    this.box = box;
    this.svg.setAttribute('viewBox', box.join(' '));
    this.resized?.();
  }

  /** How much of the plane a pixel of the screen is. */
  get unit() {
    const { clientWidth: w, clientHeight: h } = this.canvas;
    return w && h ? 1 / Math.min(w / this.box[2], h / this.box[3]) : 1;
  }

  /** The place of an event in the plane. */
  at(event) {
    const r = this.svg.getBoundingClientRect(), u = this.unit;
    return [this.box[0] + this.box[2] / 2 + (event.clientX - r.left - r.width / 2) * u,
      this.box[1] + this.box[3] / 2 + (event.clientY - r.top - r.height / 2) * u];
  }
}
