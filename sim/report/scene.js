"use strict";
// The object in 3-D with its contacts, friction cones and the forces for one wrench: WebGL without any library.
// Body frame, metres, z up. Forces arrive at the surface: an arrow ends at its contact, and the friction cone is drawn
// mirrored to the outside, so that an arrow on the cone's mantle is a finger about to slide. The torque of a finger that
// twists is an arc about the cone's axis, beyond its mouth.

const data = JSON.parse(document.getElementById("data").textContent);
const found = data.contacts.length > 0;
const COLORS = ["#d55e00", "#0072b2", "#009e73", "#c2408e", "#b8860b", "#3a9bd9", "#8c564b", "#5b5bd6"];
const LOAD = "#6d28d9";
const ARROW = 0.34; // length of an arrow of rho, and of the largest load, relative to the object's size
const DOT = 5; // diameter of a candidate, in pixels of the page
const CONE = 0.2; // height of a friction cone, relative to the object's size
const TWIST = 0.06; // radius of a torque's arc, relative to the object's size
const BEYOND = 0.24; // how far outside its contact it stands, relative to the object's size

/** Of a finger whose normal force is rho times its strength [N m]: a full arc. */
const MOST_TORQUE = Math.max(...data.contacts.map((contact) => contact.torsion * contact.strength)) * data.rho;

const colorOf = (finger) => COLORS[finger % COLORS.length];
const rgba = (hex, alpha = 1) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255).concat(alpha);
const floats = (text) => new Float32Array(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = (a) => Math.hypot(...a);
const scaled = (a, s) => a.map((x) => x * s);
const plus = (a, b, s = 1) => a.map((x, i) => x + s * b[i]);
const unit = (a) => scaled(a, 1 / length(a));

/** Two unit vectors that complete a unit vector to a right-handed frame. */
function across(axis) {
  const other = Math.abs(axis[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0];
  const u = unit(cross(other, axis));
  return [u, cross(axis, u)];
}

/** Surface swept by rings of points: triangles with a normal of their own, as one array of position and normal. */
function skin(rings) {
  const out = [];
  for (let r = 0; r + 1 < rings.length; r++) {
    for (let k = 0, n = rings[r].length; k < n; k++) {
      const [a, b, c, d] = [rings[r][k], rings[r][(k + 1) % n], rings[r + 1][(k + 1) % n], rings[r + 1][k]];
      const normal = cross(plus(c, a, -1), plus(d, b, -1));
      if (length(normal) === 0) continue;
      for (const p of [a, b, c, a, c, d]) out.push(...p, ...unit(normal));
    }
  }
  return new Float32Array(out);
}

/** Surface of revolution about `axis` through `from`; the profile is a list of [distance along it, radius]. */
function revolved(from, axis, profile, sides = 40) {
  const [u, v] = across(axis);
  return skin(profile.map(([along, radius]) => Array.from({ length: sides }, (_, k) => {
    const angle = (2 * Math.PI * k) / sides;
    const center = plus(from, axis, along);
    return plus(plus(center, u, radius * Math.cos(angle)), v, radius * Math.sin(angle));
  })));
}

/** An arrow of the vector's length that ends at `tip`. */
function arrow(tip, vector, radius) {
  const long = length(vector);
  const head = Math.min(5 * radius, 0.6 * long);
  const shape = [[0, 0], [0, radius], [long - head, radius], [long - head, 2.3 * radius], [long, 0]];
  return revolved(plus(tip, vector, -1), unit(vector), shape);
}

const sphere = (center, radius) => revolved(center, [0, 0, 1], Array.from({ length: 25 }, (_, k) => {
  const angle = (Math.PI * k) / 24;
  return [-radius * Math.cos(angle), radius * Math.sin(angle)];
}), 48);

/** An arc about `axis`, a share of three quarters long, with a head that says which way it turns. */
function turn(center, axis, share, size, radius) {
  const [u, v] = across(axis), end = 1.4 * Math.PI * share, large = radius * Math.min(1, 4 * share);
  const at = (angle) => plus(plus(center, u, size * Math.cos(angle)), v, size * Math.sin(angle));
  const rings = Array.from({ length: 49 }, (_, k) => {
    const angle = (end * k) / 48;
    const outward = unit(plus(at(angle), center, -1));
    return Array.from({ length: 12 }, (_, j) => {
      const around = (2 * Math.PI * j) / 12;
      return plus(plus(at(angle), outward, radius * Math.cos(around)), axis, radius * Math.sin(around));
    });
  });
  const heading = unit(plus(scaled(u, -Math.sin(end)), v, Math.cos(end)));
  return [skin(rings), revolved(at(end), heading, [[0, 0], [0, 2.8 * large], [6.5 * large, 0]])];
}

const VERTEX = `
  attribute vec3 position, normal; uniform mat4 view, lens; uniform float raised; uniform mediump float spot;
  varying vec3 n;
  void main() {
    n = mat3(view) * normal;
    gl_Position = lens * view * vec4(position + raised * normal, 1.0);
    gl_PointSize = spot;
  }`;
const FRAGMENT = `
  precision mediump float; uniform vec4 color; uniform float lit, spot; varying vec3 n;
  void main() {
    if (spot > 0.0 && length(gl_PointCoord - 0.5) > 0.5) discard; // points are round
    vec3 m = normalize(n);
    if (m.z < 0.0) m = -m; // every wall shows its lit side
    float key = max(dot(m, normalize(vec3(-0.4, 0.7, 0.8))), 0.0), fill = max(dot(m, vec3(0.8, -0.2, 0.5)), 0.0);
    vec3 shade = color.rgb * (0.66 + 0.36 * key + 0.12 * fill);
    gl_FragColor = vec4(mix(color.rgb, shade, lit) * color.a, color.a);
  }`;

class Scene {
  constructor(canvas) {
    this.canvas = canvas;
    this.gl = canvas.getContext("webgl", { antialias: true, premultipliedAlpha: true });
    this.moving = [];
    this.dotted = false; // whether the candidates are drawn
    this.reset();
    if (!this.gl) return;
    this.program();
    this.body = this.solid(floats(data.mesh), rgba("#bccadb", 0.62));
    this.edges = this.solid(floats(data.edges), rgba("#5a6b80"), false);
    this.candidates = { ...this.solid(floats(data.candidates), rgba("#334155"), false), dot: true };
    const tip = data.tip_radius;
    this.tips = data.contacts.map((c) => this.solid(sphere(plus(c.position, c.normal, -tip), tip), rgba("#475569")));
    this.cones = data.contacts.map((c, i) => {
      const high = CONE * data.size;
      const profile = [[0, 0], [high, c.friction * high]];
      return this.solid(revolved(c.position, scaled(c.normal, -1), profile, 64), rgba(colorOf(i), 0.2));
    });
    this.listen();
  }

  program() {
    const gl = this.gl;
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.bindAttribLocation(program, 0, "position");
    gl.bindAttribLocation(program, 1, "normal");
    gl.linkProgram(program);
    gl.useProgram(program);
    const uniforms = ["view", "lens", "color", "lit", "raised", "spot"];
    this.at = Object.fromEntries(uniforms.map((u) => [u, gl.getUniformLocation(program, u)]));
    gl.enableVertexAttribArray(0);
    gl.enableVertexAttribArray(1);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  /** Triangles (or lines) on the card. */
  solid(array, color, lit = true) {
    const buffer = this.gl.createBuffer();
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, buffer);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, array, this.gl.STATIC_DRAW);
    return { buffer, count: array.length / 6, color, lit };
  }

  reset() {
    [this.yaw, this.pitch, this.zoom] = [-0.9, 0.5, 1];
  }

  /** Show the forces that balance one wrench, where there are any, and the wrench itself at the reference point. */
  show(wrench) {
    if (!this.gl) return;
    this.moving.forEach((shape) => this.gl.deleteBuffer(shape.buffer));
    const long = ARROW * data.size, thin = 0.0075 * data.size, load = data.wrenches[wrench];
    const [force, moment] = [load.slice(0, 3), load.slice(3)];
    const most = (part) => Math.max(...data.wrenches.map((w) => length(w.slice(...part))));
    const shapes = (found ? data.forces[wrench] : []).map((f, i) => [f, data.contacts[i].position, colorOf(i)])
      .filter(([f]) => length(f) > 1e-6 * data.rho)
      .map(([f, point, color]) => [arrow(point, scaled(f, long / data.rho), thin), color]);
    (found ? data.torques[wrench] : []).forEach((torque, i) => {
      const { position, normal } = data.contacts[i], share = Math.abs(torque) / MOST_TORQUE;
      if (!(share > 1e-3)) return;
      const center = plus(position, normal, -BEYOND * data.size), axis = scaled(normal, Math.sign(torque));
      shapes.push(...turn(center, axis, share, TWIST * data.size, 0.85 * thin).map((shape) => [shape, colorOf(i)]));
    });
    if (length(force) > 0) {
      const drawn = scaled(force, long / most([0, 3]));
      shapes.push([arrow(plus(data.reference_point, drawn), drawn, thin), LOAD]);
    }
    if (length(moment) > 0) {
      const size = (0.03 + 0.09 * length(moment) / most([3, 6])) * data.size;
      shapes.push(...turn(data.reference_point, unit(moment), 1, size, 0.85 * thin).map((shape) => [shape, LOAD]));
    }
    this.moving = shapes.map(([shape, color]) => this.solid(shape, rgba(color)));
    this.draw();
  }

  /** View and projection, column by column. */
  camera() {
    const [cy, sy, cp, sp] = [Math.cos(this.yaw), Math.sin(this.yaw), Math.cos(this.pitch), Math.sin(this.pitch)];
    const [right, back] = [[-sy, cy, 0], [cy * cp, sy * cp, sp]];
    const up = cross(back, right), center = data.center, far = (1.75 * data.size) / this.zoom;
    const view = [0, 1, 2].flatMap((k) => [right[k], up[k], back[k], 0])
      .concat([-dot(right, center), -dot(up, center), -dot(back, center) - far, 1]);
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const focal = 2.1 * Math.min(1, width / height), near = 0.02 * far, end = far + 4 * data.size;
    const lens = [focal * height / width, 0, 0, 0, 0, focal, 0, 0, 0, 0, (near + end) / (near - end), -1,
      0, 0, (2 * near * end) / (near - end), 0];
    return { view, lens };
  }

  draw() {
    const gl = this.gl;
    if (!gl) return;
    const { clientWidth: width, clientHeight: height } = this.canvas, density = window.devicePixelRatio || 1;
    [this.canvas.width, this.canvas.height] = [Math.round(width * density), Math.round(height * density)];
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const { view, lens } = this.camera();
    gl.uniformMatrix4fv(this.at.view, false, view);
    gl.uniformMatrix4fv(this.at.lens, false, lens);
    [...this.tips, ...this.moving].forEach((shape) => this.paint(shape));
    this.paint(this.edges, gl.LINES);
    if (this.dotted) this.paint(this.candidates, gl.POINTS);
    this.glass(this.cones); // once behind the object's veil, once before it
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 2);
    gl.colorMask(false, false, false, false);
    this.paint(this.body); // depth alone: only the nearest wall veils what is behind it
    gl.colorMask(true, true, true, true);
    gl.enable(gl.BLEND);
    this.paint(this.body);
    gl.disable(gl.BLEND);
    gl.disable(gl.POLYGON_OFFSET_FILL);
    this.paint(this.edges, gl.LINES);
    if (this.dotted) this.paint(this.candidates, gl.POINTS);
    this.glass(this.cones);
    this.label(view, lens, width, height);
  }

  glass(shapes) {
    const gl = this.gl;
    gl.enable(gl.BLEND);
    gl.depthMask(false);
    shapes.forEach((shape) => this.paint(shape));
    gl.depthMask(true);
    gl.disable(gl.BLEND);
  }

  paint(shape, mode = this.gl.TRIANGLES) {
    const gl = this.gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, shape.buffer);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 24, 0);
    gl.vertexAttribPointer(1, 3, gl.FLOAT, false, 24, 12);
    gl.uniform4fv(this.at.color, shape.color);
    gl.uniform1f(this.at.lit, shape.lit ? 1 : 0);
    gl.uniform1f(this.at.raised, shape.dot ? 0.004 * data.size : 0); // out of the wall it lies in
    gl.uniform1f(this.at.spot, shape.dot ? DOT * (window.devicePixelRatio || 1) : 0);
    gl.drawArrays(mode, 0, shape.count);
  }

  /** Numbers stand inward of each contact, where they hide neither its arrow nor its cone. */
  label(view, lens, width, height) {
    const times = (m, p) => [0, 1, 2, 3].map((r) => m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r] * p[3]);
    const labels = document.getElementById("labels");
    data.contacts.forEach((contact, i) => {
      const badge = labels.children[i] || labels.appendChild(document.createElement("div"));
      const point = plus(contact.position, contact.normal, 0.07 * data.size);
      const [x, y, , w] = times(lens, times(view, [...point, 1]));
      badge.className = "label";
      badge.textContent = i + 1;
      badge.style.background = colorOf(i);
      badge.style.left = `${(0.5 + 0.5 * x / w) * width}px`;
      badge.style.top = `${(0.5 - 0.5 * y / w) * height}px`;
    });
  }

  listen() {
    const canvas = this.canvas;
    canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener("pointermove", (event) => {
      if (!canvas.hasPointerCapture(event.pointerId)) return;
      this.yaw -= 0.008 * event.movementX;
      this.pitch = Math.max(-1.5, Math.min(1.5, this.pitch + 0.008 * event.movementY));
      this.draw();
    });
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom = Math.max(0.3, Math.min(8, this.zoom * Math.exp(-0.001 * event.deltaY)));
      this.draw();
    }, { passive: false });
    canvas.addEventListener("dblclick", () => { this.reset(); this.draw(); });
    new ResizeObserver(() => this.draw()).observe(canvas);
  }
}
