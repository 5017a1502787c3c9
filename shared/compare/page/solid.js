// The view of a body in space that turns (solid.py): spheres and triangles, drawn by WebGL 2.
"use strict";

const POINT_SHADER = `#version 300 es
in vec3 place; in float radius; in float damage;
uniform mat3 turn; uniform vec3 middle, scale; uniform vec2 shift; uniform float pixels; uniform bool open;
uniform vec2 shown; uniform vec3 sound, steel, colors[32];
out vec3 color; out float reach;
void main() {
  vec3 p = turn * (place - middle) + vec3(shift, 0.0);
  gl_Position = vec4(p * scale, 1.0);
  if (open && place.y < 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  gl_PointSize = 2.0 * radius * pixels;
  reach = 0.5 * radius * abs(scale.z);
  int level = clamp(int(32.0 * (damage - shown.x) / (shown.y - shown.x)), 0, 31);
  color = damage > 1.0 ? steel : damage < shown.x ? sound : colors[level];
}`;
const LIT = "vec3 lit(vec3 c, vec3 n) { float l = max(dot(n, light), 0.0); return c * (0.45 + 0.55 * l) + 0.2 * pow(l, 8.0); }";
const SPHERE_SHADER = `#version 300 es
precision highp float;
in vec3 color; in float reach; uniform vec3 light; out vec4 seen; ${LIT}
void main() {
  vec2 q = vec2(2.0, -2.0) * gl_PointCoord + vec2(-1.0, 1.0);
  float s = dot(q, q);
  if (s > 1.0) discard;
  float h = sqrt(1.0 - s);
  gl_FragDepth = gl_FragCoord.z - h * reach;
  seen = vec4(lit(color, vec3(q, h)), 1.0);
}`;
const CORNER_SHADER = `#version 300 es
in vec3 place; uniform mat3 turn; uniform vec3 middle, scale; uniform vec2 shift; out vec3 at;
void main() { at = turn * (place - middle) + vec3(shift, 0.0); gl_Position = vec4(at * scale, 1.0); }`;
const FACE_SHADER = `#version 300 es
precision highp float;
in vec3 at; uniform vec3 light, steel; out vec4 seen; ${LIT}
void main() { vec3 n = normalize(cross(dFdx(at), dFdy(at))); seen = vec4(lit(steel, n.z < 0.0 ? -n : n), 1.0); }`;

const bytesOf = text => Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
const rgb = word => [1, 3, 5].map(i => parseInt(word.slice(i, i + 2), 16) / 255);

// Whole numbers of 16 bits, little endian.
function wholes(text) {
  const bytes = new DataView(bytesOf(text).buffer);
  return Array.from({length: bytes.byteLength / 2}, (_, i) => bytes.getUint16(2 * i, true));
}

// Places in mm, x, y, z of each point after the other.
function placesOf(text, {low, high}) {
  return wholes(text).map((step, i) => low[i % 3] + step / 65535 * (high[i % 3] - low[i % 3]));
}

// The whole body: images in planes of symmetry, rings revolved. Rows of place, radius and damage.
function wholeBody(solid) {
  const places = placesOf(solid.places, solid), radius = bytesOf(solid.radius), damage = bytesOf(solid.damage), rows = [];
  const signs = ["x", "y"].map(axis => solid.symmetry.split(" ").includes(axis) ? [1, -1] : [1]);
  for (let i = 0; i < radius.length; ++i) {
    const [x, y, z] = places.slice(3 * i, 3 * i + 3), r = radius[i] / 254 * solid.largest, d = damage[i] / 254;
    if (solid.symmetry === "axis") {
      const count = Math.max(1, Math.round(2 * Math.PI * Math.hypot(x, y) * solid.sphere / r));
      for (let k = 0; k < count; ++k) {
        const c = Math.cos(2 * Math.PI * k / count), s = Math.sin(2 * Math.PI * k / count);
        rows.push(c * x - s * y, s * x + c * y, z, r, d);
      }
    } else for (const a of signs[0]) for (const b of signs[1]) rows.push(a * x, b * y, z, r, d);
  }
  return new Float32Array(rows);
}

const times = (a, b) => a.map(row => [0, 1, 2].map(j => row[0] * b[0][j] + row[1] * b[1][j] + row[2] * b[2][j]));

class Solid {
  // @throws Error where the browser cannot draw it
  constructor(solid, canvas) {
    this.solid = solid;
    this.canvas = canvas;
    const gl = this.gl = canvas.getContext("webgl2", {antialias: true, preserveDrawingBuffer: true});
    if (!gl) throw new Error("no WebGL 2");
    const points = wholeBody(solid);
    this.cloud = this.shape(POINT_SHADER, SPHERE_SHADER, points, {place: 3, radius: 1, damage: 1});
    this.places = Array.from({length: this.cloud.count}, (_, i) => points.subarray(5 * i, 5 * i + 3));
    this.shapes = solid.surfaces.map(one => {
      const places = new Float32Array(placesOf(one.places, solid)), shape = this.shape(CORNER_SHADER, FACE_SHADER, places, {place: 3});
      for (let i = 0; i < places.length; i += 3) this.places.push(places.subarray(i, i + 3));
      return {...shape, count: this.indices(wholes(one.triangles))};
    });
    const [low, high] = this.ends([[1, 0, 0], [0, 1, 0], [0, 0, 1]]);
    this.middle = low.map((end, i) => (end + high[i]) / 2);
    this.size = Math.hypot(...high.map((end, i) => end - low[i])) + 2 * solid.largest;
    gl.enable(gl.DEPTH_TEST);
    gl.clearColor(1, 1, 1, 1);
    this.open = false;
    this.reset();
  }

  shape(vertex, fragment, values, parts) {
    const gl = this.gl, program = gl.createProgram(), all = Object.values(parts).reduce((a, b) => a + b);
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error("no such shaders");
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
    let begin = 0;
    for (const [name, size] of Object.entries(parts)) {
      const at = gl.getAttribLocation(program, name);
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, size, gl.FLOAT, false, 4 * all, 4 * begin);
      begin += size;
    }
    return {program, array, count: values.length / all};
  }

  indices(triangles) {
    const gl = this.gl;
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint16Array(triangles), gl.STATIC_DRAW);
    return triangles.length;
  }

  // Least and largest coordinates of all places along some directions.
  ends(directions) {
    const low = directions.map(() => Infinity), high = directions.map(() => -Infinity);
    for (const [x, y, z] of this.places)
      directions.forEach(([a, b, c], k) => {
        const along = a * x + b * y + c * z;
        low[k] = Math.min(low[k], along);
        high[k] = Math.max(high[k], along);
      });
    return [low, high];
  }

  // The first view: the body fills the picture.
  reset() {
    this.turn = this.solid.view;
    const [low, high] = this.ends(this.turn), more = 2 * this.solid.largest;
    this.zoom = Math.min(this.canvas.width / (high[0] - low[0] + more), this.canvas.height / (high[1] - low[1] + more));
    const shift = [0, 1].map(k => (low[k] + high[k]) / 2 - this.turn[k].reduce((sum, value, j) => sum + value * this.middle[j], 0));
    this.shift = shift.map(value => -value);
    this.draw();
  }

  // Turns by angles around the picture's upward and rightward directions.
  rotate(a, b) {
    const [c, s, d, t] = [Math.cos(a), Math.sin(a), Math.cos(b), Math.sin(b)];
    this.turn = times(times([[1, 0, 0], [0, d, -t], [0, t, d]], [[c, 0, s], [0, 1, 0], [-s, 0, c]]), this.turn);
    this.draw();
  }

  magnify(factor) {
    this.zoom = Math.min(50, Math.max(0.05, this.zoom * factor));
    this.draw();
  }

  draw() {
    const gl = this.gl, {width, height} = this.canvas;
    gl.viewport(0, 0, width, height);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    for (const shape of [this.cloud, ...this.shapes]) {
      const set = (kind, name, ...values) => gl[`uniform${kind}`](gl.getUniformLocation(shape.program, name), ...values);
      gl.useProgram(shape.program);
      gl.bindVertexArray(shape.array);
      set("Matrix3fv", "turn", true, this.turn.flat());
      set("3fv", "middle", this.middle);
      set("3f", "scale", 2 * this.zoom / width, 2 * this.zoom / height, -1 / this.size);
      set("2fv", "shift", this.shift);
      set("3fv", "light", this.solid.light);
      set("3fv", "steel", rgb(this.solid.steel));
      if (shape === this.cloud) {
        set("1f", "pixels", this.zoom);
        set("1i", "open", this.open ? 1 : 0);
        set("2fv", "shown", this.solid.shown);
        set("3fv", "sound", rgb(this.solid.sound));
        set("3fv", "colors", this.solid.colors.flatMap(rgb));
        gl.drawArrays(gl.POINTS, 0, shape.count);
      } else gl.drawElements(gl.TRIANGLES, shape.count, gl.UNSIGNED_SHORT, 0);
    }
  }
}
