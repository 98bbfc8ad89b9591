// Bodies found in meshes, and proxies fitted to them.
import {Body} from './body.mjs';
import {BodiceError, NONE, Owner, TIERS, triples} from './library.mjs';

/** Runs the work while `onStage` hears its stages. What it throws cancels the work, and is thrown here. */
export function withStages(library, onStage, work) {
  let thrown = null;
  library.module.onStage = stage => {
    try {
      return onStage && onStage(stage) ? 1 : 0;
    } catch (error) {
      thrown = error;
      return 1;
    }
  };
  try {
    return work();
  } catch (error) {
    throw thrown ?? error;
  } finally {
    library.module.onStage = null;
  }
}

/** The repaired mesh of a body with its landmarks and parts. */
export class Skin extends Owner {
  constructor(bodice, handle) {
    super(bodice._library, handle, '_web_skin_destroy');
    this._bodice = bodice;
    const [stature, x, y, z, vertices, triangles, input, joints, warnings] = this._library.use(call => {
      const out = call.room(Float64Array, 9);
      this._library.check(this._module._web_skin_info(this._handle, out));
      return call.get(Float64Array, out, 9);
    });
    Object.assign(this, {stature, up: [x, y, z], _vertices: vertices, _triangles: triangles, _input: input});
    const ofJoints = read => Array.from({length: joints}, (_, joint) => read(this._handle, joint));
    this.joints = ofJoints((skin, joint) => this._library.text(this._module._web_skin_joint_name(skin, joint)));
    this.jointParents = ofJoints(this._module._web_skin_joint_parent);
    this.warnings = Array.from({length: warnings},
                               (_, i) => this._library.text(this._module._web_skin_warning(this._handle, i)));
  }
  _read(Type, count, write) {
    return this._library.use(call => {
      const out = call.room(Type, count);
      this._library.check(write(out));
      return call.get(Type, out, count);
    });
  }
  get positions() {
    return this._read(Float64Array, 3 * this._vertices,
                      out => this._module._web_skin_mesh(this._live, out, this._vertices, 0, 0));
  }
  get faces() {
    return this._read(Uint32Array, 3 * this._triangles,
                      out => this._module._web_skin_mesh(this._live, 0, 0, out, this._triangles));
  }
  get parts() {
    return this._read(Uint8Array, this._vertices, out => this._module._web_skin_parts(this._live, out, this._vertices));
  }
  get vertexOfInput() {
    const found = this._read(Uint32Array, this._input,
                             out => this._module._web_skin_vertex_of_input(this._live, out, this._input));
    return Int32Array.from(found, v => v === NONE ? -1 : v);
  }
  get landmarks() {
    const names = this._bodice._landmarks, all = {};
    const values = this._read(Float64Array, 4 * names.length, out => this._module._web_skin_landmarks(this._live, out));
    names.forEach((name, i) => {
      if (values[4 * i + 3] > 0)
        all[name] = {position: [...values.subarray(4 * i, 4 * i + 3)], confidence: values[4 * i + 3]};
    });
    return all;
  }
  get measurements() {
    const names = this._bodice._measurements;
    const values = this._read(Float64Array, names.length, out => this._module._web_skin_measurements(this._live, out));
    return Object.fromEntries(names.map((name, i) => [name, values[i]]));
  }
  fit({tier, maxEllipsoids = 0, targetError = 0, onStage} = {}) {
    if (tier !== undefined && !TIERS.includes(tier))
      throw new BodiceError(`There is no tier '${tier}'. Give one of ${TIERS.join(', ')}.`);
    return withStages(this._library, onStage, () => this._library.use(call => {
      const report = call.room(Float64Array, 5);
      const body = new Body(this._library, this._module._web_fit(this._live, tier ? TIERS.indexOf(tier) : -1,
                                                                 maxEllipsoids, targetError, report));
      const [gapMean, gapP95, gapMax, interiorCovered, seconds] = call.get(Float64Array, report, 5);
      body.report = {gapMean, gapP95, gapMax, interiorCovered, seconds};
      return body;
    }));
  }
  exactDistance(points) {
    return this._bodice.exactDistance(this.positions, this.faces, points);
  }
}
