// Body proxies in WebAssembly: fits, signed distances, contacts and poses. bodice.d.ts states what each call takes.
//
//     import {load} from 'bodice';
//     const bodice = await load();
//     const skin = bodice.skin(positions, faces);        // meters; 3 numbers a vertex, 3 indices a triangle
//     const body = skin.fit({tier: 'relief'});           // or bodice.loadProxy(bytes)
//     const {distance, normal} = body.contacts(points);  // 3 floats a point
import {Body} from './body.mjs';
import {BodiceError, indices, Library, triples} from './library.mjs';
import {Skin, withStages} from './skin.mjs';

export {BodiceError};

async function readWasm(name) {
  const url = new URL(name, import.meta.url);
  if (url.protocol === 'file:' && typeof process === 'object') {
    const {readFile} = await import('node:fs/promises');
    return readFile(url);
  }
  const answer = await fetch(url);
  if (!answer.ok) throw new BodiceError(`${url} cannot be loaded (${answer.status}). Serve it beside bodice.mjs.`);
  return new Uint8Array(await answer.arrayBuffer());
}

// The smallest program with a vector in it: a function that returns sixteen zeros.
const VECTOR_PROGRAM = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0,
                                     10, 22, 1, 20, 0, 253, 12, ...new Uint8Array(16), 11);

/** Whether the engine has vectors (SIMD128), as all have since Chrome 91, Firefox 89, Safari 16.4 and node 18. */
export function hasVectors() {
  return WebAssembly.validate(VECTOR_PROGRAM);
}

/** Starts the library; `wasm` are the bytes of bodice_wasm.wasm, or of bodice_wasm_plain.wasm where the engine has no
 * vectors. They are read from beside this file if absent. */
export async function load({wasm} = {}) {
  const [{default: start}, file] = hasVectors() ? [await import('./bodice_wasm.mjs'), './bodice_wasm.wasm']
                                                : [await import('./bodice_wasm_plain.mjs'), './bodice_wasm_plain.wasm'];
  return new Bodice(await start({wasmBinary: wasm ?? await readWasm(file), printErr() {}}));
}

/** Names by number, from 0 until there is no further one. */
function namesOf(name) {
  const names = [];
  for (let next = name(0); next; next = name(names.length)) names.push(next);
  return names;
}

class Bodice {
  constructor(module) {
    this._library = new Library(module);
    const text = at => this._library.text(at);
    this.build = text(module._web_build());
    this.partNames = namesOf(i => text(module._web_part_name(i)));
    this._landmarks = namesOf(i => text(module._web_landmark_name(i)));
    this._measurements = namesOf(i => text(module._web_measurement_name(i)));
  }
  skin(positions, faces, {shape = 'person', findRig = false, onStage} = {}) {
    const vertices = triples(positions, 'positions');
    indices(faces, vertices);
    if (shape !== 'person' && shape !== 'any')
      throw new BodiceError(`There is no shape '${shape}'. Give 'person' or 'any'.`);
    return withStages(this._library, onStage, () => this._library.use(call => new Skin(
        this, this._library.module._web_skin(call.put(Float64Array, positions), vertices, call.put(Uint32Array, faces),
                                             faces.length / 3, shape === 'any' ? 1 : 0, findRig ? 1 : 0))));
  }
  builtInSkin({female = true, stature = 1.68} = {}) {
    return new Skin(this, this._library.module._web_skin_built_in(female ? 1 : 0, stature));
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
