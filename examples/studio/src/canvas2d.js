// What gl.js draws, by a 2-D canvas, for browsers without WebGL2: slower, and the same picture but for the seams.
import { WHAT } from './what.js';

const RAMP = [[0.13, 0.20, 0.38], [0.14, 0.55, 0.60], [0.88, 0.80, 0.48], [0.84, 0.25, 0.22]];
const DARK = 'rgb(41 51 71)', LIGHT = 'rgb(247 245 237)';
const SEAM_PX = 0.6;           // by which triangles overlap, so that nothing shows between them

const css = ([r, g, b], a = 1) => `rgb(${r * 255} ${g * 255} ${b * 255} / ${a})`;

function ramp(t) {
  const at = 3 * Math.min(1, Math.max(0, t)), k = Math.min(2, Math.floor(at));
  return RAMP[k].map((v, i) => v + (RAMP[k + 1][i] - v) * (at - k));
}

export class Renderer2D {
  #g; #canvas; #picture = null; #at; #from; #values; #scale = 1; #sheets = new Map();

  constructor(canvas) {
    this.#canvas = canvas;
    this.#g = canvas.getContext('2d');
  }

  picture(image) {
    this.#picture = image;
    this.#sheets.clear();
  }

  begin([left, top, width, height]) {
    const { width: w, height: h } = this.#canvas, g = this.#g, scale = Math.min(w / width, h / height);
    g.setTransform(1, 0, 0, 1, 0, 0);
    g.clearRect(0, 0, w, h);
    g.setTransform(scale, 0, 0, scale, w / 2 - scale * (left + width / 2), h / 2 - scale * (top + height / 2));
    this.#scale = scale;
  }

  vertices(at, from, values = null) { [this.#at, this.#from, this.#values] = [at, from, values]; }

  draw(what, indices, { colour = [0, 0, 0, 0], lines = false, square = 24, over = 1 } = {}) {
    if (what === WHAT.flat) { this.#flat(indices, colour, lines); return; }
    if (what === WHAT.picture || over < 1) this.#textured(indices, this.#picture, 1);
    if (what === WHAT.squares) this.#textured(indices, this.#squares(square), over);
    if (what === WHAT.values) this.#coloured(indices, over);
  }

  /** The corners of a triangle, moved out of its middle a little. */
  #corners(indices, k) {
    const p = [0, 1, 2].map((j) => [this.#at[2 * indices[k + j]], this.#at[2 * indices[k + j] + 1]]);
    const middle = [0, 1].map((a) => (p[0][a] + p[1][a] + p[2][a]) / 3);
    return p.map(([x, y]) => {
      const [u, v] = [x - middle[0], y - middle[1]], more = SEAM_PX / this.#scale / (Math.hypot(u, v) || 1);
      return [x + more * u, y + more * v];
    });
  }

  #path(corners) {
    for (const [j, [x, y]] of corners.entries()) this.#g[j === 0 ? 'moveTo' : 'lineTo'](x, y);
    this.#g.closePath();
  }

  #flat(indices, [r, g, b, a], lines) {
    const pen = this.#g, width = lines ? 2 : 3, at = this.#at;
    pen.beginPath();
    for (let k = 0; k < indices.length; k += width) {
      if (lines) {
        pen.moveTo(at[2 * indices[k]], at[2 * indices[k] + 1]);
        pen.lineTo(at[2 * indices[k + 1]], at[2 * indices[k + 1] + 1]);
      } else this.#path(this.#corners(indices, k));
    }
    [pen.fillStyle, pen.strokeStyle, pen.lineWidth] = [css([r, g, b], a), css([r, g, b], a), 1 / this.#scale];
    if (lines) pen.stroke(); else pen.fill();
  }

  #coloured(indices, over) {
    for (let k = 0; k < indices.length; k += 3) {
      const value = (this.#values[indices[k]] + this.#values[indices[k + 1]] + this.#values[indices[k + 2]]) / 3;
      this.#g.beginPath();
      this.#path(this.#corners(indices, k));
      this.#g.fillStyle = css(ramp(value), over);
      this.#g.fill();
    }
  }

  /** Each triangle of an image by the affine map that takes its corners to where they are. */
  #textured(indices, image, alpha) {
    const g = this.#g, at = this.#at, from = this.#from;
    g.globalAlpha = alpha;
    for (let k = 0; k < indices.length; k += 3) {
      const [i, j, l] = [2 * indices[k], 2 * indices[k + 1], 2 * indices[k + 2]];
      const [e, f, p, q] = [from[j] - from[i], from[j + 1] - from[i + 1], from[l] - from[i], from[l + 1] - from[i + 1]];
      const area = e * q - f * p;
      if (!area || Number.isNaN(at[i] + at[j] + at[l])) continue;
      const [column, row] = [0, 1].map((a) => {
        const [u, v] = [at[j + a] - at[i + a], at[l + a] - at[i + a]];
        return [(u * q - v * f) / area, (v * e - u * p) / area];
      });
      g.save();
      g.beginPath();
      this.#path(this.#corners(indices, k));
      g.clip();
      g.transform(column[0], row[0], column[1], row[1],
        at[i] - column[0] * from[i] - column[1] * from[i + 1], at[i + 1] - row[0] * from[i] - row[1] * from[i + 1]);
      g.drawImage(image, 0, 0);
      g.restore();
    }
    g.globalAlpha = 1;
  }

  /** A checkerboard of the picture's size. */
  #squares(side) {
    if (this.#sheets.has(side)) return this.#sheets.get(side);
    const { width, height } = this.#picture, sheet = Object.assign(document.createElement('canvas'), { width, height });
    const g = sheet.getContext('2d');
    for (let y = 0; y * side < height; ++y)
      for (let x = 0; x * side < width; ++x) {
        g.fillStyle = (x + y) % 2 === 0 ? DARK : LIGHT;
        g.fillRect(x * side, y * side, side, side);
      }
    this.#sheets.set(side, sheet);
    return sheet;
  }
}
