// The types of the package; lengths are meters.
export class BodiceError extends Error {}

export type Tier = 'paper' | 'solid' | 'tight' | 'relief';
export type Numbers = ArrayLike<number>;
/** Hears the stages of long work: "repair", "segment", "rig", "fit". A result that is true cancels. */
export type OnStage = (stage: string) => unknown;
export interface LoadOptions {
  /** The bytes of bodice_wasm.wasm, or of bodice_wasm_plain.wasm without vectors; absent: read from beside bodice.mjs. */
  wasm?: Uint8Array | ArrayBuffer;
}
/** Whether the engine has vectors (SIMD128). Without them load() takes a slower build. */
export function hasVectors(): boolean;
export function load(options?: LoadOptions): Promise<Bodice>;

export interface Bodice {
  /** One line about the library: version, ABI, compiler, instruction set. */
  readonly build: string;
  readonly partNames: string[];
  /** A body from a mesh: 3 numbers a vertex in meters, 3 indices a triangle. Any pose and up axis; 'any' takes a chair
   * or a dog. A second or two for 10,000 vertices. Throws BodiceError where no human body can be made out. */
  skin(positions: Numbers, faces: Numbers,
       options?: {shape?: 'person' | 'any'; findRig?: boolean; onStage?: OnStage}): Skin;
  /** A made body of 1.2 to 2.2 meters, to try things out. */
  builtInSkin(options?: {female?: boolean; stature?: number}): Skin;
  /** A proxy as `bodice fit -o body.bodice` writes it, or Body.toBytes(). */
  loadProxy(bytes: Uint8Array | ArrayBuffer): Body;
  /** The exact signed distance of points to a closed mesh in double precision, to judge a proxy by: 3 numbers a vertex
   * and point, 3 indices a triangle. */
  exactDistance(positions: Numbers, faces: Numbers, points: Numbers): Float64Array;
}

interface Owned {
  /** Releases the memory now; otherwise it goes some time after the object. */
  destroy(): void;
}

export interface Landmark {
  position: number[];
  /** Above 0, to 1. */
  confidence: number;
}

/** The repaired mesh of a body with its landmarks and parts. */
export interface Skin extends Owned {
  readonly stature: number;
  readonly up: number[];
  /** Names of the joints of its rig, in the order of a fitted body's. */
  readonly joints: string[];
  /** The joint that each joint hangs on, which comes before it; -1 for a root. */
  readonly jointParents: number[];
  readonly warnings: string[];
  readonly positions: Float64Array;
  readonly faces: Uint32Array;
  /** Index into Bodice.partNames of each vertex of `positions`. */
  readonly parts: Uint8Array;
  /** The vertex of `positions` for each vertex that was given; -1 where repair has dropped it. */
  readonly vertexOfInput: Int32Array;
  readonly landmarks: Record<string, Landmark>;
  /** By name, such as "waist"; NaN where one could not be taken. */
  readonly measurements: Record<string, number>;
  /** Fits a proxy; `targetError` is the wanted mean gap. Some seconds. */
  fit(options?: {tier?: Tier; maxEllipsoids?: number; targetError?: number; onStage?: OnStage}): FittedBody;
  /** The exact signed distance to this mesh in double precision, to judge a proxy by. */
  exactDistance(points: Numbers): Float64Array;
}

export interface Ellipsoid {
  center: number[];
  /** Three unit vectors. */
  axes: number[][];
  radii: number[];
  part: number;
}

export interface QueryOptions {
  /** Contacts beyond this distance are not looked for: their distance is +Infinity. */
  within?: number;
  /** To first order, in half of the time. */
  fast?: boolean;
}

export interface DistanceOptions extends QueryOptions {
  /** The distances go into this array of one element a point, which is returned: frames allocate no other. */
  into?: Float32Array;
}

export interface Contacts {
  /** Negative inside. */
  distance: Float32Array;
  point: Float32Array;
  /** Outward, unit length: the gradient of the distance. */
  normal: Float32Array;
  /** -1 without a contact. */
  ellipsoid: Int32Array;
  /** 255 without a contact. */
  part: Uint8Array;
}

/** A body proxy, at rest or in a pose. */
export interface Body extends Owned {
  readonly tier: Tier;
  readonly stature: number;
  /** 16 hexadecimal digits. */
  readonly hash: string;
  readonly joints: string[];
  readonly ellipsoids: Ellipsoid[];
  toBytes(): Uint8Array;
  /** 12 numbers: joint space to body space in the pose that the proxy was bound in, row after row. */
  bindMatrix(joint: number): Float64Array;
  /** Poses a bound proxy: 12 numbers a joint, joint space to world; `dt`: seconds since the last pose. */
  pose(matrices: Numbers, dt?: number): void;
  signedDistance(points: Numbers, options?: DistanceOptions): Float32Array;
  contacts(points: Numbers, options?: QueryOptions): Contacts;
  /** Room for particles in the memory of the library, so that frames copy nothing. */
  particles(count: number): Particles;
  /** Moves particles out that are inside or nearer than the thickness, and corrects their velocities; those of inverse
   * mass 0 stay. Returns the number of contacts. */
  resolve(particles: Particles, options?: {thickness?: number; friction?: number}): number;
}

export interface FittedBody extends Body {
  readonly report: {
    gapMean: number;
    gapP95: number;
    gapMax: number;
    /** Share of the body's interior that is inside the proxy. */
    interiorCovered: number;
    seconds: number;
  };
}

/** Views end where the library's memory grows, as in a fit: take them anew in each frame. */
export interface Particles extends Owned {
  readonly count: number;
  readonly positions: Float32Array;
  readonly velocities: Float32Array;
  /** 1 at first. */
  readonly inverseMass: Float32Array;
}
