// Body proxies in use, and particles in the memory of the library.
import {BodiceError, NONE, Owner, TIERS, triples} from './library.mjs';

/** A body proxy, at rest or in a pose. */
export class Body extends Owner {
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
  _query(points, {within = Infinity, fast = false, distanceOnly = false, into}) {
    const count = triples(points, 'points');
    if (distanceOnly && into && !(into instanceof Float32Array && into.length === count))
      throw new BodiceError(`The array "into" has ${into.length} elements. Pass a Float32Array of ${count}.`);
    return this._library.use(call => {
      const at = call.put(Float32Array, points), distance = call.room(Float32Array, count);
      const wanted = distanceOnly ? 0 : count;
      const point = wanted && call.room(Float32Array, 3 * count), normal = wanted && call.room(Float32Array, 3 * count);
      const ellipsoid = wanted && call.room(Uint32Array, count), part = wanted && call.room(Uint8Array, count);
      this._library.check(this._module._web_query(this._live, at, count, within, fast ? 1 : 0, distance, point, normal,
                                                  ellipsoid, part));
      if (distanceOnly) return {distance: call.get(Float32Array, distance, count, into)};
      const found = {distance: call.get(Float32Array, distance, count)};
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
    particles._live;  // throws where they were destroyed: their memory may have another owner
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
