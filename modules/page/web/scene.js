'use strict';
const $ = id => document.getElementById(id);
const data = JSON.parse($('data').textContent);
const bytes = text => Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer;
const [lowX, lowY, lowZ, side] = data.cube;

function positions(text) {
  const packed = new Uint16Array(bytes(text)), out = new Float32Array(packed.length), low = [lowX, lowY, lowZ];
  for (let i = 0; i < packed.length; ++i) out[i] = low[i % 3] + side * packed[i] / 65535;
  return out;
}

function normals(at, triangles) {
  const n = new Float32Array(at.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const ux = at[b] - at[a], uy = at[b + 1] - at[a + 1], uz = at[b + 2] - at[a + 2];
    const vx = at[c] - at[a], vy = at[c + 1] - at[a + 1], vz = at[c + 2] - at[a + 2];
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    for (const k of [a, b, c]) { n[k] += x; n[k + 1] += y; n[k + 2] += z; }
  }
  return n;
}

// Colors. Blue: the proxy reaches beyond the skin; red: the skin reaches beyond the proxy.
const skin = data.skin || null;
const error = skin && skin.error ? new Int16Array(bytes(skin.error)) : null;
const part = skin && skin.part ? new Uint8Array(bytes(skin.part)) : null;
const sizes = Float32Array.from(error || [], e => Math.abs(e) / 100).sort();
const share = q => sizes[Math.min(sizes.length - 1, Math.floor(q * sizes.length))] || 0;
const limit = Math.max(0.1, Number(share(0.98).toPrecision(1)));
function ramp(mm) {
  const t = Math.max(-1, Math.min(1, mm / limit)), k = Math.abs(t), end = t < 0 ? [.13, .4, .8] : [.8, .2, .16];
  return end.map(c => .92 + (c - .92) * k);
}
const skinBy = error ? 'error' : part ? 'part' : 'plain';
function skinColors(by) {
  const count = bytes(skin.positions).byteLength / 6, out = new Float32Array(3 * count);
  for (let v = 0; v < count; ++v)
    out.set(by === 'error' ? ramp(error[v] / 100) : by === 'part' ? data.colors[part[v]] : [.82, .7, .62], 3 * v);
  return out;
}
const flat = (count, color) => { const out = new Float32Array(3 * count); for (let i = 0; i < count; ++i) out.set(color, 3 * i); return out; };

// Ellipsoids as one mesh: a sphere, moved into each.
const ring = 20, rows = 12, sphere = [], sphereTriangles = [];
for (let j = 0; j <= rows; ++j) for (let i = 0; i <= ring; ++i) {
  const u = 2 * Math.PI * i / ring, v = Math.PI * j / rows;
  sphere.push([Math.cos(u) * Math.sin(v), Math.cos(v), Math.sin(u) * Math.sin(v)]);
}
for (let j = 0; j < rows; ++j) for (let i = 0; i < ring; ++i) {
  const a = j * (ring + 1) + i, b = a + ring + 1;
  sphereTriangles.push(a, a + 1, b, b, a + 1, b + 1);
}
function ellipsoidMesh(text) {
  const m = new Float32Array(bytes(text)), count = m.length / 12, at = new Float32Array(3 * count * sphere.length);
  let w = 0;
  for (let e = 0; e < count; ++e) for (const p of sphere) for (let k = 0; k < 3; ++k)
    at[w++] = m[12 * e + k] + p[0] * m[12 * e + 3 + k] + p[1] * m[12 * e + 6 + k] + p[2] * m[12 * e + 9 + k];
  return at;
}

// Meshes by name. `parts`: the part of each vertex, where it has one.
const meshes = {}, hidden = new Set();
function addMesh(name, frames, triangles, colors, on, parts) { meshes[name] = {frames, triangles, colors, on, parts, shown: triangles, dirty: true}; }
// Leaves out the triangles of hidden parts.
function showParts() {
  for (const mesh of Object.values(meshes)) {
    if (!mesh.parts) continue;
    const kept = [];
    if (hidden.size) for (let t = 0; t < mesh.triangles.length; t += 3)
      if (!hidden.has(mesh.parts[mesh.triangles[t]])) kept.push(mesh.triangles[t], mesh.triangles[t + 1], mesh.triangles[t + 2]);
    mesh.shown = hidden.size ? new Uint32Array(kept) : mesh.triangles;
    mesh.dirty = true;
  }
}
const times = data.times || [];
const frameOf = (item, decode, first) => item.frames ? item.frames.map(f => () => decode(f)) : [() => decode(first)];
if (skin) addMesh('skin', frameOf(skin, positions, skin.positions), new Uint32Array(bytes(skin.triangles)), skinColors(skinBy), true, part);
if (data.ellipsoids) {
  const owner = new Uint8Array(bytes(data.ellipsoids.part)), triangles = [], colors = [], parts = [];
  owner.forEach((p, e) => {
    for (const t of sphereTriangles) triangles.push(t + e * sphere.length);
    for (const _ of sphere) { colors.push(...data.colors[p]); parts.push(p); }
  });
  addMesh('ellipsoids', frameOf(data.ellipsoids, ellipsoidMesh, data.ellipsoids.shapes), new Uint32Array(triangles), new Float32Array(colors), !skin && !data.surface, parts);
}
if (data.surface) {
  const at = positions(data.surface.positions);
  addMesh("proxy's surface", [() => at], new Uint32Array(bytes(data.surface.triangles)), flat(at.length / 3, [.5, .68, .6]), !skin);
}
(data.cloth || []).forEach((cloth, i) => {
  const triangles = new Uint32Array(bytes(cloth.triangles)), first = positions(cloth.frames[0]);
  addMesh(cloth.name, frameOf(cloth, positions), triangles, cloth.colors ? Float32Array.from(new Uint8Array(bytes(cloth.colors)), c => c / 255)
    : flat(first.length / 3, [[.25, .45, .62], [.55, .4, .62], [.6, .52, .3]][i % 3]), true);
});
let showLandmarks = false;

// The view.
const stage = $('stage'), canvas = $('view');
const gl = canvas.getContext('webgl', {antialias: true, alpha: true, preserveDrawingBuffer: true});
const large = gl && gl.getExtension('OES_element_index_uint');
const start = {yaw: .5, pitch: .1, zoom: 1, focus: null};
let {yaw, pitch, zoom, focus} = start, frame = 0, playing = false;
let center = [lowX + side / 2, lowY + side / 2, lowZ + side / 2];
{
  const first = meshes.skin || Object.values(meshes)[0], at = first ? first.frames[0]() : center, low = [1e9, 1e9, 1e9], high = [-1e9, -1e9, -1e9];
  at.forEach((v, i) => { low[i % 3] = Math.min(low[i % 3], v); high[i % 3] = Math.max(high[i % 3], v); });
  center = low.map((v, k) => (v + high[k]) / 2);
}
const home = center.slice();

let program, uniform = {};
function shader(type, text) { const s = gl.createShader(type); gl.shaderSource(s, text); gl.compileShader(s); return s; }
if (large) {
  program = gl.createProgram();
  gl.attachShader(program, shader(gl.VERTEX_SHADER, `attribute vec3 at, normal, color; uniform mat4 view; uniform mat3 turn;
    varying vec3 n, c; void main() { gl_Position = view * vec4(at, 1.0); n = turn * normal; c = color; }`));
  gl.attachShader(program, shader(gl.FRAGMENT_SHADER, `precision mediump float; varying vec3 n, c; void main() {
    vec3 u = normalize(n); if (!gl_FrontFacing) u = -u;
    float light = 0.42 + 0.5 * max(0.0, dot(u, vec3(0.3, 0.5, 0.81))) + 0.1 * max(0.0, dot(u, vec3(-0.8, 0.2, 0.5)));
    gl_FragColor = vec4(c * light, 1.0); }`));
  ['at', 'normal', 'color'].forEach((name, i) => gl.bindAttribLocation(program, i, name));
  gl.linkProgram(program);
  gl.useProgram(program);
  for (const name of ['view', 'turn']) uniform[name] = gl.getUniformLocation(program, name);
  gl.enable(gl.DEPTH_TEST);
  $('still').hidden = true;
  $('still').style.display = 'none';
} else {
  $('note').textContent = 'This browser has no WebGL: the picture stays still.';
}

function upload(mesh) {
  const at = mesh.frames[Math.min(frame, mesh.frames.length - 1)]();
  mesh.buffers = mesh.buffers || [0, 1, 2, 3].map(() => gl.createBuffer());
  [at, normals(at, mesh.triangles), mesh.colors].forEach((values, i) => {
    gl.bindBuffer(gl.ARRAY_BUFFER, mesh.buffers[i]);
    gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
  });
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, mesh.buffers[3]);
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, mesh.shown, gl.STATIC_DRAW);
  mesh.dirty = false;
}

// The share of the view's height that the legend takes, where the view is so narrow that it would cover the feet.
function belowLegend() {
  const legend = $('legend');
  return stage.clientWidth < 700 && legend.offsetHeight ? Math.min(.3, (legend.offsetHeight + 14) / stage.clientHeight) : 0;
}
function matrices() {
  const cy = Math.cos(yaw), sy = Math.sin(yaw), cp = Math.cos(pitch), sp = Math.sin(pitch);
  const turn = [[cy, 0, -sy], [-sy * sp, cp, -cy * sp], [sy * cp, sp, cy * cp]].map(r => r);
  const aspect = canvas.width / Math.max(1, canvas.height), f = 2.6, far = 1.5 * side / zoom * Math.max(1, .75 / aspect) * 1.05;
  const view = new Float32Array(16), near = .02 * side, end = far + 4 * side;
  const below = belowLegend(), size = f * (1 - below);
  const move = turn.map(r => -(r[0] * center[0] + r[1] * center[1] + r[2] * center[2]));
  move[2] -= far;
  for (let c = 0; c < 4; ++c) {
    const column = c < 3 ? [turn[0][c], turn[1][c], turn[2][c]] : move;
    view[4 * c] = size / aspect * column[0];
    view[4 * c + 1] = size * column[1] - below * column[2];
    view[4 * c + 2] = -(end + near) / (end - near) * column[2] - (c === 3 ? 2 * end * near / (end - near) : 0);
    view[4 * c + 3] = -column[2];
  }
  return {view, turn: new Float32Array([0, 1, 2].flatMap(c => [turn[0][c], turn[1][c], turn[2][c]]))};
}

let waiting = false;
function draw() { if (!waiting) { waiting = true; requestAnimationFrame(paint); } }
function paint() {
  waiting = false;
  if (!large) return;
  const scale = Math.min(2, window.devicePixelRatio || 1);
  const w = Math.round(stage.clientWidth * scale), h = Math.round(stage.clientHeight * scale);
  if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
  gl.viewport(0, 0, w, h);
  gl.clearColor(0, 0, 0, 0);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  const {view, turn} = matrices();
  gl.uniformMatrix4fv(uniform.view, false, view);
  gl.uniformMatrix3fv(uniform.turn, false, turn);
  for (const mesh of Object.values(meshes)) {
    if (!mesh.on) continue;
    if (mesh.dirty) upload(mesh);
    for (let i = 0; i < 3; ++i) {
      gl.bindBuffer(gl.ARRAY_BUFFER, mesh.buffers[i]);
      gl.enableVertexAttribArray(i);
      gl.vertexAttribPointer(i, 3, gl.FLOAT, false, 0, 0);
    }
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, mesh.buffers[3]);
    gl.drawElements(gl.TRIANGLES, mesh.shown.length, gl.UNSIGNED_INT, 0);
  }
  label(view);
}

const labels = data.landmarks.map(l => {
  const span = document.createElement('span'), name = document.createElement('b');
  name.textContent = l.name;
  span.append('\u25cf ', name);
  $('labels').append(span);
  return span;
});
// Dots for all landmarks, and the names that do not cover another one.
function label(view) {
  const named = [];
  data.landmarks.forEach((l, i) => {
    const clip = [0, 1, 3].map(r => view[r] * l.at[0] + view[4 + r] * l.at[1] + view[8 + r] * l.at[2] + view[12 + r]);
    labels[i].hidden = !showLandmarks || clip[2] <= 0;
    const x = (clip[0] / clip[2] + 1) / 2 * stage.clientWidth - 10, y = (1 - clip[1] / clip[2]) / 2 * stage.clientHeight - 8;
    labels[i].style.left = x + 'px';
    labels[i].style.top = y + 'px';
    const end = x + 24 + 6 * l.name.length, free = named.every(n => Math.abs(n.y - y) > 11 || n.x > end || n.end < x + 12);
    labels[i].lastChild.hidden = !free;
    if (free && !labels[i].hidden) named.push({x: x + 12, end, y});
  });
}

