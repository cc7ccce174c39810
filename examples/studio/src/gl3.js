// Triangles in space by WebGL2: flat faces, lit, with their edges.
import { buffersOf, contextOf, programOf } from './gl.js';

const VERTEX = `#version 300 es
uniform mat4 view; in vec3 at, corner; in vec4 tone; out vec3 place, c; out vec4 t;
void main() { place = at; c = corner; t = tone; gl_Position = view * vec4(at, 1); }`;
const FRAGMENT = `#version 300 es
precision highp float; in vec3 place, c; in vec4 t; uniform vec3 eye; out vec4 colour;
void main() {
  vec3 n = normalize(cross(dFdx(place), dFdy(place)));
  float light = .42 + .58 * abs(dot(n, normalize(eye)));
  vec3 w = fwidth(c), s = smoothstep(vec3(0), w * 1.1, c);
  float edge = min(s.x, min(s.y, s.z));
  colour = vec4(mix(t.rgb * light * .55, t.rgb * light, mix(1., edge, t.a)), 1);
}`;

const multiply = (a, b) => Float32Array.from({ length: 16 }, (_, i) => {
  let sum = 0;
  for (let k = 0; k < 4; ++k) sum += a[(i % 4) + 4 * k] * b[k + 4 * Math.floor(i / 4)];
  return sum;
});

/** The matrix of a camera that goes round a centre. */
export function camera({ turn, tilt, distance, centre = [0, 0, 0] }, ratio) {
  const [s, c, u, v] = [Math.sin(turn), Math.cos(turn), Math.sin(tilt), Math.cos(tilt)];
  const rotation = [c, u * s, v * s, 0, 0, v, -u, 0, -s, u * c, v * c, 0, 0, 0, 0, 1];
  const [near, far, f] = [0.1, 50, 2.2];
  const project = [f / Math.max(1, ratio), 0, 0, 0, 0, f / Math.max(1, 1 / ratio), 0, 0,
    0, 0, (far + near) / (near - far), -1, 0, 0, (2 * far * near) / (near - far), 0];
  const shift = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -centre[0], -centre[1], -centre[2], 1];
  const back = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -distance, 1];
  return { matrix: multiply(project, multiply(back, multiply(rotation, shift))), eye: [v * s, -u === 0 ? 0 : u, v * c] };
}

export class Renderer3 {
  #gl; #canvas; #buffers; #uniforms; #n = 0;

  constructor(canvas) {
    this.#canvas = canvas;
    const gl = this.#gl = contextOf(canvas);
    if (!gl) throw new Error('This mode draws with WebGL2, which this browser does not offer.');
    const program = programOf(gl, VERTEX, FRAGMENT);
    this.#buffers = buffersOf(gl, program, { at: 3, corner: 3, tone: 4 });
    this.#uniforms = { view: gl.getUniformLocation(program, 'view'), eye: gl.getUniformLocation(program, 'eye') };
    gl.enable(gl.DEPTH_TEST);
  }

  /** Triangles: for each corner three coordinates, how far it is from each edge, and a tone (red, green, blue,
   *  how strong its edges are). */
  triangles(at, corners, tones) {
    const gl = this.#gl, n = at.length / 3;
    const fill = (name, values) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.#buffers[name]);
      gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
    };
    fill('at', Float32Array.from(at));
    fill('corner', Float32Array.from(corners));
    fill('tone', tones);
    this.#n = n;
  }

  draw(look) {
    const gl = this.#gl, ratio = Math.min(2, globalThis.devicePixelRatio || 1);
    const w = Math.max(1, Math.round(this.#canvas.clientWidth * ratio)), h = Math.max(1, Math.round(this.#canvas.clientHeight * ratio));
    if (this.#canvas.width !== w || this.#canvas.height !== h) [this.#canvas.width, this.#canvas.height] = [w, h];
    gl.viewport(0, 0, w, h);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const { matrix, eye } = camera(look, w / h);
    gl.uniformMatrix4fv(this.#uniforms.view, false, matrix);
    gl.uniform3f(this.#uniforms.eye, ...eye);
    if (this.#n > 0) gl.drawArrays(gl.TRIANGLES, 0, this.#n);
  }
}
