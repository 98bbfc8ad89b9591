// The readers of OBJ and GLB, and units by size.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import path from 'node:path';
import {pathToFileURL} from 'node:url';
import test from 'node:test';

const {readMesh, readObj, findUnit} = await import(pathToFileURL(process.env.BODICE_WEB + '/readers.mjs'));
const bytes = text => new TextEncoder().encode(text);

/** A GLB of a JSON text and floats and indices in one buffer. */
function glb(json, numbers, indices) {
  const binary = new Uint8Array(4 * numbers.length + 4 * Math.ceil(indices.length / 2));
  new Float32Array(binary.buffer, 0, numbers.length).set(numbers);
  new Uint16Array(binary.buffer, 4 * numbers.length, indices.length).set(indices);
  const text = bytes(JSON.stringify(json)), padded = new Uint8Array(Math.ceil(text.length / 4) * 4).fill(32);
  padded.set(text);
  const out = new Uint8Array(28 + padded.length + binary.length), view = new DataView(out.buffer);
  [0x46546C67, 2, out.length, padded.length, 0x4E4F534A].forEach((word, i) => view.setUint32(4 * i, word, true));
  out.set(padded, 20);
  view.setUint32(20 + padded.length, binary.length, true);
  view.setUint32(24 + padded.length, 0x004E4942, true);
  out.set(binary, 28 + padded.length);
  return out;
}
const triangle = (nodes, more = {}) => glb({
  asset: {version: '2.0'}, scene: 0, scenes: [{nodes: [0]}], nodes,
  meshes: [{primitives: [{attributes: {POSITION: 0}, indices: 1}]}],
  accessors: [{bufferView: 0, componentType: 5126, count: 3, type: 'VEC3'},
              {bufferView: 1, componentType: 5123, count: 3, type: 'SCALAR'}],
  bufferViews: [{buffer: 0, byteOffset: 0, byteLength: 36}, {buffer: 0, byteOffset: 36, byteLength: 6}],
  buffers: [{byteLength: 44}], ...more}, [1, 0, 0, 0, 1, 0, 0, 0, 1], [0, 1, 2]);

test('an OBJ with quads, slashes, negative indices and comments becomes triangles', () => {
  const {positions, faces} = readObj('# a\nv 0 0 0\nv 1 0 0 1 1 1\r\nv 1 1 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3//1 4\nf -4 -3 -2\n');
  assert.deepEqual([...positions], [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0]);
  assert.deepEqual([...faces], [0, 1, 2, 0, 2, 3, 0, 1, 2]);
});

test('a GLB is moved by its nodes: scale, then rotation, then translation, parents last', () => {
  const half = Math.SQRT1_2;
  const {positions, faces} = readMesh(triangle([
    {children: [1], translation: [0, 0, 5]},
    {mesh: 0, translation: [10, 0, 0], rotation: [0, 0, half, half], scale: [2, 3, 4]}]));
  // The rotation takes x to y and y to -x.
  const expected = [10, 2, 5, 7, 0, 5, 10, 0, 9];
  positions.forEach((x, i) => assert.ok(Math.abs(x - expected[i]) < 1e-12, `${x} is not ${expected[i]}`));
  assert.deepEqual([...faces], [0, 1, 2]);
});

test('the mesh of a skin stays where it is bound', () => {
  const {positions} = readMesh(triangle([{mesh: 0, skin: 0, translation: [7, 7, 7]}]));
  assert.deepEqual([...positions], [1, 0, 0, 0, 1, 0, 0, 0, 1]);
});

test('what cannot be read is one sentence with the name of the file', () => {
  const bad = [
    [bytes('v 0 0\n'), /b.x, line 1: 'v 0 0' is no vertex/], [bytes('v 0 0 0\nf 1 2 3\n'), /triangle 0 has vertex 1/],
    [bytes('f 0 1 2\n'), /Number them from 1/], [bytes('v 0 0 0\nf 1 1\n'), /fewer than three/],
    [bytes('hello'), /no triangles/], [new Uint8Array(64), /neither OBJ nor GLB/],
    [triangle([{mesh: 3}]), /mesh 3 does not exist/], [triangle([{children: [0]}]), /stands in the scene twice/],
    [triangle([{mesh: 0}], {extensionsRequired: ['KHR_draco_mesh_compression']}), /without compression/],
    [triangle([{mesh: 0}], {bufferViews: [{buffer: 0, byteOffset: 1e9, byteLength: 36}]}), /the end of accessor 0/],
    [triangle([{mesh: 0}]).subarray(0, 100), /cut off or damaged/]];
  for (const [data, sentence] of bad) assert.throws(() => readMesh(data, 'b.x'), sentence);
});

test('no cut and no changed byte of a GLB does more than throw an Error', () => {
  const whole = triangle([{mesh: 0}]);
  let state = 1, thrown = 0;
  const random = n => Math.floor((state = (state * 48271) % 2147483647) / 2147483647 * n);
  for (let i = 0; i < 2000; ++i) {
    const data = whole.slice(0, random(4) ? whole.length : random(whole.length));
    for (let k = 0; k < 3 && data.length; ++k) data[random(data.length)] = random(256);
    try {
      readMesh(data, 'b.glb');
    } catch (error) {
      assert.match(error.message, /^b\.glb/, error.stack);
      ++thrown;
    }
  }
  assert.ok(thrown > 200 && thrown < 2000, `${thrown} of 2000`);
});

test('units are found by the size of a person', () => {
  for (const [size, unit] of [[1.7, 'meters'], [170, 'centimeters'], [1700, 'millimeters'], [67, 'inches'], [5.6, 'feet']])
    assert.equal(findUnit([0, 0, 0, 0.3 * size, size, 0.1 * size]).unit, unit);
  assert.throws(() => findUnit([0, 0, 0, 0, 30, 0]), /no person/);
});

test('a rigged GLB of the program holds the mesh of its OBJ, where its skin is bound', () => {
  const folder = mkdtempSync(path.join(tmpdir(), 'bodice-readers-'));
  try {
    const file = name => path.join(folder, name), program = process.env.BODICE_PROGRAM;
    execFileSync(program, ['make', '-o', file('body.obj'), '-q']);
    execFileSync(program, ['rig', file('body.obj'), '-o', file('body.glb'), '-q']);
    const [obj, glb] = ['body.obj', 'body.glb'].map(name => readMesh(readFileSync(file(name)), name));
    assert.ok(obj.positions.length > 20000);
    assert.deepEqual(glb.faces, obj.faces);
    assert.equal(glb.positions.length, obj.positions.length);
    assert.ok(obj.positions.every((x, i) => Math.abs(x - glb.positions[i]) < 1e-6));
    assert.equal(findUnit(glb.positions).unit, 'meters');
  } finally {
    rmSync(folder, {recursive: true});
  }
});
