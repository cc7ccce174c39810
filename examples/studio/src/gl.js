// Pictures on triangles, by WebGL2. A piecewise linear map is what a GPU draws anyway, so what is seen is
// the map, up to the filter between pixels.

const VERTEX = `#version 300 es
uniform vec4 view; uniform vec2 size;
in vec2 at, from; in float value;
out vec2 uv, place; out float v;
void main() {
  uv = from / size; place = from; v = value;
  gl_Position = vec4(at * view.xy + view.zw, 0, 1);
}`;

// what: as in what.js; a value is from 0 to 1, shown as a colour
const FRAGMENT = `#version 300 es
precision highp float;
uniform sampler2D picture; uniform int what; uniform vec4 flat_colour; uniform float square, over;
in vec2 uv, place; in float v; out vec4 colour;
vec3 ramp(float t) {
  const vec3 a = vec3(.13, .20, .38), b = vec3(.14, .55, .60), c = vec3(.88, .80, .48), d = vec3(.84, .25, .22);
  return t < .33 ? mix(a, b, t / .33) : t < .66 ? mix(b, c, (t - .33) / .33) : mix(c, d, (t - .66) / .34);
}
void main() {
  vec4 p = texture(picture, uv);
  if (what == 3) { colour = flat_colour; return; }
  if (what == 2) { colour = vec4(mix(p.rgb, ramp(clamp(v, 0., 1.)), over), 1); return; }
  if (what == 1) {
    vec2 s = place / square, w = fwidth(s) * .7 + 1e-6;
    vec2 f = abs(fract(s * .5) * 2. - 1.), e = smoothstep(.5 - w, .5 + w, f);
    float t = e.x * (1. - e.y) + e.y * (1. - e.x);
    colour = vec4(mix(p.rgb, mix(vec3(.16, .20, .28), vec3(.97, .96, .93), t), over), 1);
    return;
  }
  colour = p;
}`;

/** A program of two shaders. */
export function programOf(gl, vertex, fragment) {
  const program = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost())
      throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  gl.useProgram(program);
  return program;
}

/** Buffers for the attributes of a program, { name: numbers of a vertex }. */
export function buffersOf(gl, program, widths) {
  return Object.fromEntries(Object.entries(widths).map(([name, width]) => {
    const place = gl.getAttribLocation(program, name), buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, width, gl.FLOAT, false, 0, 0);
    return [name, buffer];
  }));
}

/** WebGL2 on a canvas; null where the browser does not offer it. */
export const contextOf = (canvas) => canvas.getContext('webgl2', { antialias: true, preserveDrawingBuffer: true });

export class Renderer {
  #gl; #canvas; #buffers; #uniforms; #picture = null; #redraw;

  /** gl: the canvas' context; redraw: called when that has been lost and restored. */
  constructor(canvas, gl, redraw) {
    this.#canvas = canvas;
    this.#redraw = redraw;
    this.#gl = gl;
    canvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
    canvas.addEventListener('webglcontextrestored', () => {
      this.#prepare();
      if (this.#picture) this.picture(this.#picture);
      this.#redraw();
    });
    this.#prepare();
  }

  #prepare() {
    const gl = this.#gl, program = programOf(gl, VERTEX, FRAGMENT);
    this.#buffers = { index: gl.createBuffer(), ...buffersOf(gl, program, { at: 2, from: 2, value: 1 }) };
    this.#uniforms = Object.fromEntries(['view', 'size', 'what', 'flat_colour', 'square', 'over']
      .map((name) => [name, gl.getUniformLocation(program, name)]));
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  picture(image) {
    const gl = this.#gl;
    this.#picture = image;
    gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, true);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, image);
    gl.generateMipmap(gl.TEXTURE_2D);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    gl.uniform2f(this.#uniforms.size, image.width, image.height);
  }

  /** Begins a frame; box: what of the plane is to be seen, [left, top, width, height]. */
  begin([left, top, width, height]) {
    const gl = this.#gl, { width: w, height: h } = this.#canvas;
    gl.viewport(0, 0, w, h);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    const scale = Math.min(w / width, h / height);             // as SVG's xMidYMid meet
    const sx = 2 * scale / w, sy = -2 * scale / h;
    gl.uniform4f(this.#uniforms.view, sx, sy, -sx * (left + width / 2), -sy * (top + height / 2));
  }

  #fill(name, values) {
    const gl = this.#gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#buffers[name]);
    gl.bufferData(gl.ARRAY_BUFFER, values instanceof Float32Array ? values : Float32Array.from(values), gl.DYNAMIC_DRAW);
  }

  /** Places of vertices, where they are in the picture, and a value for each, or null. */
  vertices(at, from, values = null) {
    this.#fill('at', at);
    this.#fill('from', from);
    this.#fill('value', values ?? new Float32Array(at.length / 2));
  }

  /** Triangles (or lines) between the vertices. */
  draw(what, indices, { colour = [0, 0, 0, 0], lines = false, square = 24, over = 1 } = {}) {
    if (indices.length === 0) return;
    const gl = this.#gl, u = this.#uniforms, [r, g, b, a] = colour;
    gl.uniform1i(u.what, what);
    gl.uniform4f(u.flat_colour, r * a, g * a, b * a, a);
    gl.uniform1f(u.square, square);
    gl.uniform1f(u.over, over);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.#buffers.index);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.DYNAMIC_DRAW);
    gl.drawElements(lines ? gl.LINES : gl.TRIANGLES, indices.length, gl.UNSIGNED_INT, 0);
  }
}
