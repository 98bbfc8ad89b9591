// The package in WebAssembly beside the program of this machine: the same proxy gives the same distances; particles
// come out; poses move; failures are sentences.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync, writeFileSync} from 'node:fs';
import path from 'node:path';
import {pathToFileURL} from 'node:url';
import test from 'node:test';

const {BODICE_WEB: web, BODICE_SCRATCH: scratch, BODICE_PROGRAM: program} = process.env;
const {hasVectors, load, BodiceError} = await import(pathToFileURL(path.join(web, 'bodice.mjs')));
const {readMesh} = await import(pathToFileURL(path.join(web, 'readers.mjs')));
const bodice = await load();
const file = name => path.join(scratch, name);
// The program makes a proxy, its surface as a mesh, and a proxy that follows a skeleton.
execFileSync(program, ['fit', '-o', file('native.bodice'), '--surface', file('surface.obj'), '--surface-mm', '20', '-q']);
const body = bodice.loadProxy(readFileSync(file('native.bodice')));
const surface = readMesh(readFileSync(file('surface.obj')), 'surface.obj');

/** Points within some centimeters of the surface, repeatable. */
function around(count) {
  const {positions} = surface;
  let state = 1;
  const random = () => (state = (state * 48271) % 2147483647) / 2147483647;
  return Float32Array.from({length: 3 * count},
                           (_, i) => positions[(21 * Math.floor(i / 3) + i % 3) % positions.length] + 0.06 * (random() - 0.5));
}

test('an engine without vectors takes the build without, which gives the same distances', async () => {
  const validate = WebAssembly.validate;
  assert.equal(hasVectors(), true);
  WebAssembly.validate = () => false;
  const plain = await load().finally(() => WebAssembly.validate = validate);
  assert.doesNotMatch(plain.build, /WASM/);
  assert.match(bodice.build, /WASM/);
  const points = around(2000), other = plain.loadProxy(readFileSync(file('native.bodice')));
  const distance = body.signedDistance(points);
  other.signedDistance(points).forEach((d, i) => assert.ok(Math.abs(d - distance[i]) < 2e-6));
  assert.equal(plain.builtInSkin().fit({tier: 'solid'}).hash, bodice.builtInSkin().fit({tier: 'solid'}).hash);
});

test('the library states its version and build', () => {
  assert.match(bodice.build, /^bodice 0\.1\.0/);
  assert.equal(bodice.partNames[0], 'head');
  assert.equal(bodice.partNames.length, 31);  // 15 of persons, 16 of things
  assert.equal(body.ellipsoids.length, 89);
  assert.equal(body.tier, 'relief');
  assert.ok(Math.abs(body.stature - 1.68) < 0.05);
});

test('a proxy of the native program gives its distances', () => {
  const points = around(2000);
  writeFileSync(file('points.txt'), Array.from({length: 2000}, (_, i) => points.subarray(3 * i, 3 * i + 3).join(' ')).join('\n'));
  const native = execFileSync(program, ['query', file('native.bodice'), file('points.txt')], {encoding: 'utf8', maxBuffer: 1 << 26})
                     .split('\n').filter(line => line && !line.startsWith('#')).map(line => Number(line.split(/\s+/)[0]));
  assert.equal(native.length, 2000);
  const distance = body.signedDistance(points);
  const into = new Float32Array(2000);
  assert.equal(body.signedDistance(points, {into}), into);
  assert.deepEqual(into, distance);
  assert.throws(() => body.signedDistance(points, {into: new Float32Array(1999)}), /1999 elements. Pass a Float32Array of 2000/);
  let worst = 0;
  distance.forEach((d, i) => { worst = Math.max(worst, Math.abs(d - native[i])); });
  assert.ok(worst < 2e-6, `they differ by ${worst} m`);
});

test('the vertices of the surface lie on it, and a proxy is what its bytes say', () => {
  const distance = body.signedDistance(surface.positions);
  assert.ok(distance.reduce((sum, d) => sum + Math.abs(d), 0) / distance.length < 0.001);
  const again = bodice.loadProxy(body.toBytes());
  assert.equal(again.hash, body.hash);
  again.destroy();
  assert.throws(() => again.signedDistance([0, 0, 0]), BodiceError);
});

test('the exact distance to a box is that of its formula', () => {
  const corners = [], half = [0.2, 0.3, 0.1], points = around(500);
  for (let i = 0; i < 8; ++i) half.forEach((h, k) => corners.push(i >> k & 1 ? h : -h));
  const faces = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5];
  const exact = bodice.exactDistance(corners, faces, points);
  for (let i = 0; i < 500; ++i) {
    const q = half.map((h, k) => Math.abs(points[3 * i + k]) - h);
    const expected = Math.hypot(...q.map(x => Math.max(x, 0))) + Math.min(0, Math.max(...q));
    assert.ok(Math.abs(exact[i] - expected) < 1e-12);
  }
});

test('particles inside come out, pinned ones stay, and contacts have unit normals', () => {
  const count = 3000, start = around(count), particles = body.particles(count);
  particles.positions.set(start);
  particles.inverseMass[0] = 0;
  const inside = body.signedDistance(start).filter(d => d < 0).length;
  const contacts = body.resolve(particles, {thickness: 0.001});
  assert.ok(contacts >= inside - 1 && inside > 500);
  assert.deepEqual([...particles.positions.subarray(0, 3)], [...start.subarray(0, 3)]);
  const after = body.signedDistance(particles.positions);
  assert.ok(after.filter((d, i) => i > 0 && d < 0.0009).length < 0.005 * count);
  const contact = body.contacts(start);
  for (let i = 0; i < count; ++i) {
    assert.ok(Math.abs(Math.hypot(...contact.normal.subarray(3 * i, 3 * i + 3)) - 1) < 1e-3);
    assert.ok(contact.part[i] < 15 && contact.ellipsoid[i] >= 0);
  }
  assert.ok(body.signedDistance(start, {within: 0.01}).every(d => d <= 0.0101 || d === Infinity));
  particles.destroy();
  assert.throws(() => body.resolve(particles), /was destroyed/);
});

test('a bound proxy moves with its joints', () => {
  execFileSync(program, ['rig', '-o', file('rigged.glb'), '-q']);
  execFileSync(program, ['fit', file('rigged.glb'), '--tier', 'solid', '-o', file('bound.bodice'), '-q']);
  const bound = bodice.loadProxy(readFileSync(file('bound.bodice')));
  assert.ok(bound.joints.length > 15);
  const points = around(500), rest = bound.signedDistance(points);
  const matrices = new Float32Array(12 * bound.joints.length);
  bound.joints.forEach((_, j) => { matrices.set(bound.bindMatrix(j), 12 * j); matrices[12 * j + 3] += 1; });
  bound.pose(matrices);
  const moved = bound.signedDistance(points.map((x, i) => i % 3 ? x : x + 1));
  moved.forEach((d, i) => assert.ok(Math.abs(d - rest[i]) < 1e-4));
});

test('failures are one sentence', () => {
  assert.throws(() => bodice.loadProxy(new Uint8Array(100)), BodiceError);
  const damaged = body.toBytes();
  damaged[damaged.length >> 1] ^= 1;
  assert.throws(() => bodice.loadProxy(damaged), BodiceError);
  assert.throws(() => body.pose(new Float32Array(12)), /not bound/);
  assert.throws(() => body.pose(new Float32Array(7)), /Pass 12/);
  assert.throws(() => body.signedDistance([0, 0]), /Pass three/);
  assert.throws(() => bodice.exactDistance([0, 0, 0], [0, 1, 2], []), /Face 0 has vertex 1/);
  assert.throws(() => body.particles(-1), BodiceError);
});
