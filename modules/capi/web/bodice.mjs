// Body proxies in WebAssembly: signed distances, contacts, responses and poses. bodice.d.ts says what each call takes.
//
//     import {load} from 'bodice';
//     const bodice = await load();
//     const body = bodice.loadProxy(bytes);              // of `bodice fit body.obj -o body.bodice`
//     const {distance, normal} = body.contacts(points);  // 3 floats a point, meters
import start from './bodice_wasm.mjs';

const TIERS = ['paper', 'solid', 'tight', 'relief'];
const NONE = 0xFFFFFFFF;

/** What bodice refuses, in one sentence with its remedy. */
export class BodiceError extends Error {
  constructor(sentence) {
    super(sentence);
    this.name = 'BodiceError';
  }
}

async function readWasm() {
  const url = new URL('./bodice_wasm.wasm', import.meta.url);
  if (url.protocol === 'file:' && typeof process === 'object') {
    const {readFile} = await import('node:fs/promises');
    return readFile(url);
  }
  const answer = await fetch(url);
  if (!answer.ok) throw new BodiceError(`${url} cannot be loaded (${answer.status}). Serve it beside bodice.mjs.`);
  return new Uint8Array(await answer.arrayBuffer());
}

/** Starts the library; `wasm` are the bytes of bodice_wasm.wasm, which are read from beside this file if absent. */
export async function load({wasm} = {}) {
  return new Bodice(await start({wasmBinary: wasm ?? await readWasm(), printErr() {}}));
}

/** Memory of the library for one call. */
class Call {
  constructor(module) {
    this.module = module;
    this.blocks = [];
  }
  /** The address of room for `count` elements of `Type`. */
  room(Type, count) {
    const at = this.module._malloc(Math.max(8, count * Type.BYTES_PER_ELEMENT));
    if (!at) throw new BodiceError('The memory of WebAssembly is full. Release bodies that are not used.');
    this.blocks.push(at);
    return at;
  }
  put(Type, values) {
    const at = this.room(Type, values.length);
    new Type(this.module.HEAPU8.buffer, at, values.length).set(values);
    return at;
  }
  get(Type, at, count) {
    return new Type(this.module.HEAPU8.buffer, at, count).slice();
  }
  end() {
    for (const block of this.blocks) this.module._free(block);
  }
}

class Library {
  constructor(module) {
    this.module = module;
    // A handle whose object is gone is released some time later; destroy() does it at once.
    this.lost = new FinalizationRegistry(({destroy, handle}) => this.module[destroy](handle));
  }
  use(work) {
    const call = new Call(this.module);
    try {
      return work(call);
    } finally {
      call.end();
    }
  }
  fail() {
    throw new BodiceError(this.text(this.module._web_error()));
  }
  check(status) {
    if (status !== 0) this.fail();
  }
  text(at) {
    return at ? this.module.UTF8ToString(at) : '';
  }
}

class Owner {
  constructor(library, handle, destroy) {
    if (!handle) library.fail();
    this._library = library;
    this._module = library.module;
    this._handle = handle;
    this._destroy = destroy;
    library.lost.register(this, {destroy, handle}, this);
  }
  get _live() {
    if (!this._handle) throw new BodiceError('This object was destroyed. Make another one.');
    return this._handle;
  }
  destroy() {
    if (!this._handle) return;
    this._library.lost.unregister(this);
    this._module[this._destroy](this._handle);
    this._handle = 0;
  }
}

function triples(values, what) {
  if (!values || typeof values.length !== 'number' || values.length % 3 !== 0)
    throw new BodiceError(`The ${what} have ${values?.length} numbers. Pass three for each, one after another.`);
  return values.length / 3;
}

function indices(faces, vertices) {
  triples(faces, 'faces');
  for (let i = 0; i < faces.length; ++i)
    if (!(Number.isInteger(faces[i]) && faces[i] >= 0 && faces[i] < vertices))
      throw new BodiceError(`Face ${Math.floor(i / 3)} has vertex ${faces[i]}, and there are ${vertices} vertices. ` +
                            'Number them from 0.');
  return faces;
}

class Bodice {
  constructor(module) {
    this._library = new Library(module);
    const text = at => this._library.text(at);
    this.build = text(module._web_build());
    this.partNames = Array.from({length: 15}, (_, i) => text(module._web_part_name(i)));
  }
  loadProxy(bytes) {
    const data = bytes instanceof ArrayBuffer ? new Uint8Array(bytes) : bytes;
    return this._library.use(
        call => new Body(this._library, this._library.module._web_load(call.put(Uint8Array, data), data.length)));
  }
  exactDistance(positions, faces, points) {
    const vertices = triples(positions, 'positions'), count = triples(points, 'points');
    indices(faces, vertices);
    return this._library.use(call => {
      const out = call.room(Float64Array, count);
      this._library.check(this._library.module._web_exact(
          call.put(Float64Array, positions), vertices, call.put(Uint32Array, faces), faces.length / 3,
          call.put(Float64Array, points), count, out));
      return call.get(Float64Array, out, count);
    });
  }
}

class Body extends Owner {
  constructor(library, handle) {
    super(library, handle, '_web_body_destroy');
    const [ellipsoids, joints, tier, stature, high, low] = this._library.use(call => {
      const out = call.room(Float64Array, 6);
      library.check(this._module._web_body_info(this._handle, out));
      return call.get(Float64Array, out, 6);
    });
    this.tier = TIERS[tier];
    this.stature = stature;
    this.hash = (BigInt(high) << 32n | BigInt(low)).toString(16).padStart(16, '0');
    this.joints = Array.from({length: joints}, (_, i) => library.text(this._module._web_joint_name(this._handle, i)));
    this._ellipsoids = ellipsoids;
  }
  get ellipsoids() {
    const values = this._library.use(call => {
      const out = call.room(Float64Array, 16 * this._ellipsoids);
      this._library.check(this._module._web_ellipsoids(this._live, out, this._ellipsoids));
      return call.get(Float64Array, out, 16 * this._ellipsoids);
    });
    return Array.from({length: this._ellipsoids}, (_, i) => {
      const e = [...values.subarray(16 * i, 16 * i + 16)];
      return {center: e.slice(0, 3), axes: [e.slice(3, 6), e.slice(6, 9), e.slice(9, 12)], radii: e.slice(12, 15),
              part: e[15]};
    });
  }
  toBytes() {
    return this._library.use(call => {
      const size = this._module._web_body_bytes(this._live, 0, 0);
      const at = call.room(Uint8Array, size);
      if (this._module._web_body_bytes(this._live, at, size) !== size) this._library.fail();
      return call.get(Uint8Array, at, size);
    });
  }
  bindMatrix(joint) {
    return this._library.use(call => {
      const at = call.room(Float64Array, 12);
      this._library.check(this._module._web_bind_matrix(this._live, joint, at));
      return call.get(Float64Array, at, 12);
    });
  }
  pose(matrices, dt = 0) {
    if (matrices.length % 12 !== 0)
      throw new BodiceError(`The matrices have ${matrices.length} numbers. Pass 12 for each joint, row after row.`);
    this._library.use(call => this._library.check(
        this._module._web_pose(this._live, call.put(Float32Array, matrices), matrices.length / 12, dt)));
  }
  signedDistance(points, options) {
    return this._query(points, {...options, distanceOnly: true}).distance;
  }
  contacts(points, options) {
    return this._query(points, options ?? {});
  }
  _query(points, {within = Infinity, fast = false, distanceOnly = false}) {
    const count = triples(points, 'points');
    return this._library.use(call => {
      const at = call.put(Float32Array, points), distance = call.room(Float32Array, count);
      const wanted = distanceOnly ? 0 : count;
      const point = wanted && call.room(Float32Array, 3 * count), normal = wanted && call.room(Float32Array, 3 * count);
      const ellipsoid = wanted && call.room(Uint32Array, count), part = wanted && call.room(Uint8Array, count);
      this._library.check(this._module._web_query(this._live, at, count, within, fast ? 1 : 0, distance, point, normal,
                                                  ellipsoid, part));
      const found = {distance: call.get(Float32Array, distance, count)};
      if (distanceOnly) return found;
      found.point = call.get(Float32Array, point, 3 * count);
      found.normal = call.get(Float32Array, normal, 3 * count);
      found.ellipsoid = Int32Array.from(call.get(Uint32Array, ellipsoid, count), e => e === NONE ? -1 : e);
      found.part = call.get(Uint8Array, part, count);
      return found;
    });
  }
  particles(count) {
    return new Particles(this._library, count);
  }
  resolve(particles, {thickness = 0, friction = 0.3} = {}) {
    const contacts = this._module._web_resolve(this._live, particles._position, particles._velocity,
                                               particles._inverseMass, particles.count, thickness, friction);
    if (contacts < 0) this._library.fail();
    return contacts;
  }
}

/** Particles in the memory of the library: nothing is copied in a frame. */
class Particles extends Owner {
  constructor(library, count) {
    if (!(Number.isInteger(count) && count >= 0)) throw new BodiceError(`There cannot be ${count} particles.`);
    const at = library.module._malloc(Math.max(8, 28 * count));
    if (!at) throw new BodiceError('The memory of WebAssembly is full. Release bodies that are not used.');
    super(library, at, '_free');
    this.count = count;
    this._position = at;
    this._velocity = at + 12 * count;
    this._inverseMass = at + 24 * count;
    this.velocities.fill(0);
    this.inverseMass.fill(1);
  }
  _view(at, length) {
    this._live;
    return new Float32Array(this._module.HEAPU8.buffer, at, length);
  }
  // Views end where the library's memory grows, as in a fit: take them anew in each frame.
  get positions() {
    return this._view(this._position, 3 * this.count);
  }
  get velocities() {
    return this._view(this._velocity, 3 * this.count);
  }
  get inverseMass() {
    return this._view(this._inverseMass, this.count);
  }
}
