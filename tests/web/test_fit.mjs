// Skins and fits in WebAssembly beside those of the program of this machine: the same mesh has the same landmarks and as
// near a proxy, what its report states is so by the exact distance, bones carry it, and failures are sentences.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync, writeFileSync} from 'node:fs';
import path from 'node:path';
import {pathToFileURL} from 'node:url';
import test from 'node:test';

const {BODICE_WEB: web, BODICE_SCRATCH: scratch, BODICE_PROGRAM: program} = process.env;
const {load, BodiceError} = await import(pathToFileURL(path.join(web, 'bodice.mjs')));
const {readMesh} = await import(pathToFileURL(path.join(web, 'readers.mjs')));
const bodice = await load();
const file = name => path.join(scratch, name);
execFileSync(program, ['make', '-o', file('made.obj'), '-q']);
execFileSync(program, ['fit', file('made.obj'), '-o', file('made.bodice'), '--report', file('made.json'), '-q']);
const native = JSON.parse(readFileSync(file('made.json'), 'utf8'));
const {positions, faces} = readMesh(readFileSync(file('made.obj')), 'made.obj');
const stages = [];
const skin = bodice.skin(positions, faces, {onStage: stage => { stages.push(stage); }});
const body = skin.fit();

test('a skin has the landmarks, the stature and the measurements of the native one', () => {
  assert.deepEqual([...new Set(stages)], ['repair', 'segment']);
  assert.ok(Math.abs(skin.stature - native.height_m) < 1e-6);
  for (const {name, position, confidence} of native.landmarks) {
    if (!confidence) continue;
    const found = skin.landmarks[name];
    assert.ok(Math.hypot(...position.map((x, k) => x - found.position[k])) < 1e-4, name);
  }
  assert.ok(skin.measurements.waist > 0.6 && skin.measurements.waist < 0.9);
  assert.equal(skin.vertexOfInput.length, positions.length / 3);
  assert.equal(skin.parts.length, skin.positions.length / 3);
  assert.ok(new Set(skin.parts).size === 15);
});

test('a fit is as near to the skin as the native one, and its bytes are read by the program', () => {
  assert.equal(body.ellipsoids.length, native.ellipsoids);
  assert.equal(body.tier, 'relief');
  const ratio = 1000 * body.report.gapMean / native.accuracy.gap_mm.mean;
  assert.ok(Math.abs(ratio - 1) < 0.1, `${ratio} times the native gap`);
  assert.ok(Math.abs(100 * body.report.interiorCovered - native.accuracy.interior_covered_percent) < 0.1);
  writeFileSync(file('of_web.bodice'), body.toBytes());
  writeFileSync(file('one.txt'), '0.3 1.2 0.1\n');
  const answer = execFileSync(program, ['query', file('of_web.bodice'), file('one.txt')], {encoding: 'utf8'});
  const distance = Number(answer.split('\n').find(line => line && !line.startsWith('#')).split(/\s+/)[0]);
  assert.ok(Math.abs(distance - body.signedDistance([0.3, 1.2, 0.1])[0]) < 2e-6);
});

test('the exact distance to the skin is what the report states', () => {
  const points = Float64Array.from({length: 3000}, (_, i) => positions[(63 * Math.floor(i / 3) + i % 3) % positions.length]);
  const exact = skin.exactDistance(points), fast = body.signedDistance(points);
  const mean = exact.reduce((sum, d, i) => sum + Math.abs(d - fast[i]), 0) / exact.length;
  assert.ok(exact.every(d => Math.abs(d) < 1e-9));
  assert.ok(mean > 0.2 * body.report.gapMean && mean < 5 * body.report.gapMean, `${mean} m`);
});

test('the same call gives the same bits, and another tier another proxy', () => {
  const again = skin.fit();
  assert.equal(again.hash, body.hash);
  again.destroy();
  const solid = skin.fit({tier: 'solid', maxEllipsoids: 60});
  assert.equal(solid.tier, 'solid');
  assert.ok(solid.ellipsoids.length <= 60 && solid.report.gapMean > body.report.gapMean);
  assert.throws(() => skin.fit({tier: 'best'}), /There is no tier/);
});

test('a found rig carries the proxy that is fitted with it', () => {
  const rigged = bodice.skin(positions, faces, {findRig: true});
  assert.ok(rigged.joints.length > 15);
  const parentOf = name => rigged.joints[rigged.jointParents[rigged.joints.indexOf(name)]];
  assert.deepEqual(['pelvis', 'calf_l', 'hand_r'].map(parentOf), [undefined, 'thigh_l', 'forearm_r']);
  const bound = rigged.fit({tier: 'solid'}), points = positions.slice(0, 1500);
  const rest = bound.signedDistance(points), matrices = new Float32Array(12 * bound.joints.length);
  bound.joints.forEach((_, j) => { matrices.set(bound.bindMatrix(j), 12 * j); matrices[12 * j + 3] += 1; });
  bound.pose(matrices);
  const moved = bound.signedDistance(points.map((x, i) => i % 3 ? x : x + 1));
  rest.forEach((d, i) => assert.ok(Math.abs(d - moved[i]) < 1e-4));
});

test('what is no person is taken on request', () => {
  const corners = [], half = [0.2, 0.3, 0.1];
  for (let i = 0; i < 8; ++i) half.forEach((h, k) => corners.push(i >> k & 1 ? h : -h));
  const box = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5];
  const thing = bodice.skin(corners, box, {shape: 'any'}).fit();
  assert.ok(thing.signedDistance([0, 0, 0])[0] < -0.02);
  assert.ok(Math.abs(thing.signedDistance([0, 0.5, 0])[0] - 0.2) < 0.01);
  assert.throws(() => bodice.skin(corners, box), BodiceError);
  assert.throws(() => bodice.skin(corners, box, {shape: 'chair'}), /There is no shape/);
});

test('failures are sentences, and what a hook throws comes out', () => {
  assert.throws(() => bodice.skin(positions.map(x => 100 * x), faces), /0\.01/);
  assert.throws(() => bodice.skin([0, 0], []), /Pass three/);
  assert.throws(() => bodice.skin([0, 0, 0], [0, 1, 2]), /Face 0 has vertex 1/);
  assert.throws(() => bodice.skin(positions, faces, {onStage() { throw new RangeError('stop'); }}), RangeError);
  assert.throws(() => skin.fit({onStage: () => true}), /host stopped/);
  const built = bodice.builtInSkin({female: false, stature: 1.8});
  assert.ok(Math.abs(built.stature - 1.8) < 0.03);
  assert.throws(() => bodice.builtInSkin({stature: 9}), /1\.2 to 2\.2/);
  built.destroy();
  assert.throws(() => built.fit(), BodiceError);
});
