// Colored triangle meshes in WebGL, turned by dragging.
const VERTEX = `attribute vec3 at, normal, color; uniform mat4 view; uniform mat3 turn; varying vec3 n, c;
  void main() { gl_Position = view * vec4(at, 1.0); n = turn * normal; c = color; }`;
const FRAGMENT = `precision mediump float; varying vec3 n, c; uniform float alpha;
  void main() {
    vec3 u = normalize(n);
    if (!gl_FrontFacing) u = -u;
    float light = 0.42 + 0.5 * max(0.0, dot(u, vec3(0.3, 0.5, 0.81))) + 0.1 * max(0.0, dot(u, vec3(-0.8, 0.2, 0.5)));
    gl_FragColor = vec4(c * light, alpha);
  }`;

function normalsOf(at, faces) {
  const out = new Float32Array(at.length);
  for (let t = 0; t < faces.length; t += 3) {
    const [a, b, c] = [3 * faces[t], 3 * faces[t + 1], 3 * faces[t + 2]];
    const u = [0, 1, 2].map(k => at[b + k] - at[a + k]), v = [0, 1, 2].map(k => at[c + k] - at[a + k]);
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    for (const corner of [a, b, c])
      for (let k = 0; k < 3; ++k) out[corner + k] += n[k];
  }
  return out;
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const scaled = (a, s) => a.map(x => x * s);
const sum = (...all) => [0, 1, 2].map(k => all.reduce((total, a) => total + a[k], 0));

export class View {
  constructor(canvas) {
    this.canvas = canvas;
    this.meshes = [];
    this.yaw = 0.5;
    this.pitch = 0.1;
    this.zoom = 1;
    this.center = [0, 0, 0];
    this.size = 1;
    this.axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    this.gl = canvas.getContext('webgl', {antialias: true, preserveDrawingBuffer: true});
    if (!this.gl || !this.gl.getExtension('OES_element_index_uint')) {
      this.gl = null;
      return;
    }
    this.link();
    this.listen();
  }
  link() {
    const gl = this.gl, program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    ['at', 'normal', 'color'].forEach((name, i) => gl.bindAttribLocation(program, i, name));
    gl.linkProgram(program);
    gl.useProgram(program);
    this.uniform = Object.fromEntries(['view', 'turn', 'alpha'].map(name => [name, gl.getUniformLocation(program, name)]));
    gl.enable(gl.DEPTH_TEST);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
  }
  listen() {
    const held = new Map();
    this.canvas.onpointerdown = event => {
      held.set(event.pointerId, event);
      this.canvas.setPointerCapture(event.pointerId);
    };
    this.canvas.onpointerup = this.canvas.onpointercancel = event => held.delete(event.pointerId);
    this.canvas.onpointermove = event => {
      const before = held.get(event.pointerId);
      if (!before || held.size > 1) return;
      this.yaw -= (event.clientX - before.clientX) / 150;
      this.pitch = Math.max(-1.5, Math.min(1.5, this.pitch + (event.clientY - before.clientY) / 150));
      held.set(event.pointerId, event);
      this.draw();
    };
    this.canvas.addEventListener('wheel', event => {
      event.preventDefault();
      this.zoom = Math.max(0.3, Math.min(12, this.zoom * Math.exp(-event.deltaY / 600)));
      this.draw();
    }, {passive: false});
    addEventListener('resize', () => this.draw());
  }
  /** Looks at a body: `up` points from its feet to its head. */
  frame(positions, up) {
    const low = [1e9, 1e9, 1e9], high = [-1e9, -1e9, -1e9];
    positions.forEach((x, i) => { low[i % 3] = Math.min(low[i % 3], x); high[i % 3] = Math.max(high[i % 3], x); });
    this.center = low.map((x, k) => (x + high[k]) / 2);
    this.size = Math.max(...high.map((x, k) => x - low[k]));
    const length = Math.sqrt(dot(up, up)) || 1, y = up.map(x => x / length);
    const aside = Math.abs(y[0]) < 0.7 ? [1, 0, 0] : [0, 0, 1];
    const z = cross(aside, y), z1 = scaled(z, 1 / Math.sqrt(dot(z, z)));
    this.axes = [cross(y, z1), y, z1];
  }
  clear() {
    for (const mesh of this.meshes) mesh.buffers.forEach(buffer => this.gl.deleteBuffer(buffer));
    this.meshes = [];
  }
  add(positions, faces, colors, alpha) {
    if (!this.gl) return;
    const gl = this.gl, buffers = [positions, normalsOf(positions, faces), colors].map(values => {
      const buffer = gl.createBuffer();
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
      return buffer;
    });
    const index = gl.createBuffer();
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, index);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, faces, gl.STATIC_DRAW);
    this.meshes.push({buffers: [...buffers, index], count: faces.length, alpha});
    this.meshes.sort((a, b) => b.alpha - a.alpha);  // what is seen through comes last
  }
  matrices() {
    const [x, y, z] = this.axes, [cy, sy, cp, sp] = [Math.cos(this.yaw), Math.sin(this.yaw), Math.cos(this.pitch), Math.sin(this.pitch)];
    const right = sum(scaled(x, cy), scaled(z, -sy)), toEye = sum(scaled(x, sy * cp), scaled(y, sp), scaled(z, cy * cp));
    const rows = [right, cross(toEye, right), toEye];
    const aspect = this.canvas.width / Math.max(1, this.canvas.height), f = 2.6, near = 0.02 * this.size;
    const far = 1.5 * this.size / this.zoom * Math.max(1, 0.75 / aspect), end = far + 4 * this.size;
    const move = rows.map(row => -dot(row, this.center));
    move[2] -= far;
    const view = new Float32Array(16);
    for (let c = 0; c < 4; ++c) {
      const column = c < 3 ? rows.map(row => row[c]) : move;
      view[4 * c] = f / aspect * column[0];
      view[4 * c + 1] = f * column[1];
      view[4 * c + 2] = -(end + near) / (end - near) * column[2] - (c === 3 ? 2 * end * near / (end - near) : 0);
      view[4 * c + 3] = -column[2];
    }
    return {view, turn: Float32Array.from([0, 1, 2].flatMap(c => rows.map(row => row[c])))};
  }
  draw() {
    if (this.gl && !this.waiting) this.waiting = requestAnimationFrame(() => this.paint());
  }
  paint() {
    this.waiting = 0;
    const {gl, canvas, uniform} = this, scale = Math.min(2, devicePixelRatio || 1);
    const [w, h] = [canvas.clientWidth, canvas.clientHeight].map(size => Math.round(size * scale));
    if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
    gl.viewport(0, 0, w, h);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const {view, turn} = this.matrices();
    gl.uniformMatrix4fv(uniform.view, false, view);
    gl.uniformMatrix3fv(uniform.turn, false, turn);
    for (const {buffers, count, alpha} of this.meshes) {
      alpha < 1 ? gl.enable(gl.BLEND) : gl.disable(gl.BLEND);
      gl.uniform1f(uniform.alpha, alpha);
      for (let i = 0; i < 3; ++i) {
        gl.bindBuffer(gl.ARRAY_BUFFER, buffers[i]);
        gl.enableVertexAttribArray(i);
        gl.vertexAttribPointer(i, 3, gl.FLOAT, false, 0, 0);
      }
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffers[3]);
      gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, 0);
    }
  }
}
