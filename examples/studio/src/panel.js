// A panel: a picture by WebGL, or without it by a 2-D canvas, under a drawing of handles.
import { Renderer2D } from './canvas2d.js';
import { make } from './dom.js';
import { Renderer, contextOf } from './gl.js';
import { energiesOf, linesOf } from './mesh.js';
import { Sheet } from './sheet.js';
import { WHAT } from './what.js';

const MARGIN = 0.1;            // around the picture, as a share of its longer side
const RED = [0.86, 0.16, 0.14, 0.92];

const equal = (a, b) => a === b || (a && b && a.length === b.length && a.every((v, i) => v === b[i]));

/** Makes a canvas as large as it is seen, in pixels of the screen. */
function fit(canvas) {
  const ratio = Math.min(2, globalThis.devicePixelRatio || 1);
  const [w, h] = [canvas.clientWidth, canvas.clientHeight].map((side) => Math.max(1, Math.round(side * ratio)));
  if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
}

export class Panel extends Sheet {
  #image = null; #last = null;

  constructor(title, { role } = {}) {
    const redraw = () => this.redraw();
    super(title, { role, redraw });
    this.badge = make('output', { class: 'badge' });
    this.caption.append(this.badge);
    const gl = contextOf(this.canvas);
    this.renderer = gl ? new Renderer(this.canvas, gl, redraw) : new Renderer2D(this.canvas);
  }

  /** The picture, and so what of the plane is seen. */
  picture(image) {
    const { width, height } = image, margin = MARGIN * Math.max(width, height);
    this.#image = image;
    this.renderer.picture(image);
    this.look([-margin, -margin, width + 2 * margin, height + 2 * margin]);
  }

  look(box) {
    super.look(box);
    this.redraw();
  }

  /** Shows triangles: { at, from, triangles, folded, values } and how: { look, mesh, whole }. */
  show(mesh, view) {
    const [old, how] = this.#last ?? [];
    const still = old && equal(old.at, mesh.at) && equal(old.from, mesh.from) && equal(old.triangles, mesh.triangles)
      && old.values === mesh.values && equal(old.folded, mesh.folded) && JSON.stringify(how) === JSON.stringify(view);
    this.#last = [mesh, view];
    if (!still) this.redraw();
  }

  redraw() {
    if (!this.#last || !this.#image) return;
    const [{ at, from, triangles, folded, values }, view] = this.#last, r = this.renderer;
    fit(this.canvas);
    r.begin(this.box);
    if (view.whole) this.#whole(view.whole);
    if (!triangles) return;
    const square = Math.max(this.#image.width, this.#image.height) / 32;
    if (view.look === 'heat') this.#heat(at, from, triangles, view.energies);
    else {
      r.vertices(at, from, values);
      r.draw(WHAT[view.look] ?? 0, triangles, { square, over: view.over ?? 1 });
    }
    if (view.look === 'heat') r.vertices(at, from);
    if (view.mesh) r.draw(WHAT.flat, linesOf(triangles), { lines: true, colour: view.ink ?? [0.1, 0.3, 0.5, 0.45] });
    if (folded?.length) r.draw(WHAT.flat, folded, { colour: RED });
  }

  /** All of the picture, faint. */
  #whole(strength) {
    const { width: w, height: h } = this.#image, corners = [0, 0, w, 0, w, h, 0, h];
    this.renderer.vertices(corners, corners);
    this.renderer.draw(WHAT.picture, Uint32Array.of(0, 1, 2, 0, 2, 3));
    const [r, g, b] = strength;
    this.renderer.draw(WHAT.flat, Uint32Array.of(0, 1, 2, 0, 2, 3), { colour: [r, g, b, strength[3]] });
  }

  /** The energy of each triangle as its colour: 4 is an isometry, 40 and more the far end. */
  #heat(at, from, triangles, energies = energiesOf(from, at, triangles)) {
    const n = triangles.length, p = new Float32Array(2 * n), q = new Float32Array(2 * n), v = new Float32Array(n);
    for (let k = 0; k < n; ++k) {
      const i = triangles[k];
      p[2 * k] = at[2 * i]; p[2 * k + 1] = at[2 * i + 1];
      q[2 * k] = from[2 * i]; q[2 * k + 1] = from[2 * i + 1];
      v[k] = Math.log10(Math.max(energies[(k / 3) | 0], 4) / 4);
    }
    this.renderer.vertices(p, q, v);
    this.renderer.draw(WHAT.values, Uint32Array.from({ length: n }, (_, k) => k), { over: 0.86 });
  }
}

