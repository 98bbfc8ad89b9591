// Small readers of body files; everything happens in memory.
export interface MeshFile {
  /** 3 numbers a vertex, as the file has them. */
  positions: Float64Array;
  faces: Uint32Array;
}
/** By the bytes: OBJ as text, GLB by its mark. Throws Error with a sentence that names the file. */
export function readMesh(bytes: Uint8Array | ArrayBuffer, name?: string): MeshFile;
export function readObj(text: string, name?: string): MeshFile;
/** Triangles of all meshes of the scene, moved by their nodes; skinned ones as they are bound. */
export function readGlb(bytes: Uint8Array, name?: string): MeshFile;
/** The unit in which the mesh is as large as a person: its name, and meters a unit. */
export function findUnit(positions: ArrayLike<number>): {unit: string; meters: number};
