// What the classes of the package share: memory and failures of the library, and owners of its handles.

export const TIERS = ['paper', 'solid', 'tight', 'relief'];
/** No ellipsoid, no vertex. */
export const NONE = 0xFFFFFFFF;

/** What bodice refuses, in one sentence with its remedy. */
export class BodiceError extends Error {
  constructor(sentence) {
    super(sentence);
    this.name = 'BodiceError';
  }
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
  get(Type, at, count, into = new Type(count)) {
    into.set(new Type(this.module.HEAPU8.buffer, at, count));
    return into;
  }
  end() {
    for (const block of this.blocks) this.module._free(block);
  }
}

export class Library {
  constructor(module) {
    this.module = module;
    // A handle without its object is released some time later; destroy() does it at once.
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

export class Owner {
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

export function triples(values, what) {
  if (!values || typeof values.length !== 'number' || values.length % 3 !== 0)
    throw new BodiceError(`The ${what} have ${values?.length} numbers. Pass three for each, one after another.`);
  return values.length / 3;
}

export function indices(faces, vertices) {
  triples(faces, 'faces');
  for (let i = 0; i < faces.length; ++i)
    if (!(Number.isInteger(faces[i]) && faces[i] >= 0 && faces[i] < vertices))
      throw new BodiceError(`Face ${Math.floor(i / 3)} has vertex ${faces[i]}, and there are ${vertices} vertices. ` +
                            'Number them from 0.');
  return faces;
}
