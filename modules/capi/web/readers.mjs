// Readers of OBJ and GLB for body files: positions and triangles, nothing else. Units are found by size.
// Based on: Wavefront Technologies. Object files (.obj), appendix B1. 1992; Khronos Group. glTF 2.0 specification. 2021.

const UNITS = [['meters', 1], ['centimeters', 0.01], ['millimeters', 0.001], ['inches', 0.0254], ['feet', 0.3048],
               ['decimeters', 0.1]];

/** The unit in which the mesh is as large as a person. */
export function findUnit(positions) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; ++i) {
    low[i % 3] = Math.min(low[i % 3], positions[i]);
    high[i % 3] = Math.max(high[i % 3], positions[i]);
  }
  const size = Math.max(...high.map((h, k) => h - low[k]));
  for (const [unit, meters] of UNITS)
    if (size * meters >= 1.2 && size * meters <= 2.3) return {unit, meters};
  throw new Error(`The mesh is ${size.toPrecision(3)} units large, which is no person in any unit. Scale it to meters.`);
}

export function readMesh(bytes, name = 'the file') {
  const data = bytes instanceof ArrayBuffer ? new Uint8Array(bytes) : bytes;
  if (data.length >= 4 && data[0] === 0x67 && data[1] === 0x6C && data[2] === 0x54 && data[3] === 0x46)
    return readGlb(data, name);
  if (data.subarray(0, 1000).some(byte => byte === 0))
    throw new Error(`${name} is neither OBJ nor GLB. Save the body as one of these.`);
  return readObj(new TextDecoder().decode(data), name);
}

export function readObj(text, name = 'the file') {
  const positions = [], faces = [];
  let line = 0;
  for (const row of text.split('\n')) {
    ++line;
    const words = row.trim().split(/\s+/);
    if (words[0] === 'v') {
      const xyz = words.slice(1, 4).map(Number);
      if (xyz.length < 3 || !xyz.every(Number.isFinite))
        throw new Error(`${name}, line ${line}: '${row.trim().slice(0, 40)}' is no vertex. Give three numbers.`);
      positions.push(...xyz);
    } else if (words[0] === 'f') {
      const count = positions.length / 3;
      const corners = words.slice(1).map(word => {
        const number = Number(word.split('/')[0]);
        const index = number < 0 ? count + number : number - 1;
        if (!Number.isInteger(number) || number === 0 || index < 0)
          throw new Error(`${name}, line ${line}: '${word}' is no vertex. Number them from 1.`);
        return index;
      });
      if (corners.length < 3) throw new Error(`${name}, line ${line}: a face has fewer than three vertices. Remove it.`);
      for (let i = 2; i < corners.length; ++i) faces.push(corners[0], corners[i - 1], corners[i]);
    }
  }
  return checked(positions, faces, name);
}

function checked(positions, faces, name) {
  if (faces.length === 0) throw new Error(`${name} has no triangles. Export the body's mesh.`);
  const count = positions.length / 3;
  for (let i = 0; i < faces.length; ++i)
    if (faces[i] >= count)
      throw new Error(`${name}: triangle ${Math.floor(i / 3)} has vertex ${faces[i]}, and there are ${count} vertices. ` +
                      'Export it again.');
  return {positions: Float64Array.from(positions), faces: Uint32Array.from(faces)};
}

const COMPONENTS = {5120: Int8Array, 5121: Uint8Array, 5122: Int16Array, 5123: Uint16Array, 5125: Uint32Array,
                    5126: Float32Array};
const WIDTHS = {SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4};

function chunksOf(data, name) {
  const broken = () => new Error(`${name} is cut off or damaged. Export it again.`);
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  if (data.length < 20 || view.getUint32(4, true) !== 2)
    throw new Error(`${name} is not glTF 2.0. Export it as glTF 2.0 binary (.glb).`);
  const chunks = {};
  for (let at = 12; at + 8 <= data.length;) {
    const length = view.getUint32(at, true), kind = view.getUint32(at + 4, true);
    if (at + 8 + length > data.length) throw broken();
    chunks[kind] ??= data.subarray(at + 8, at + 8 + length);
    at += 8 + length + (4 - length % 4) % 4;
  }
  if (!chunks[0x4E4F534A]) throw broken();
  try {
    return {json: JSON.parse(new TextDecoder().decode(chunks[0x4E4F534A])), binary: chunks[0x004E4942]};
  } catch {
    throw broken();
  }
}

export function readGlb(data, name = 'the file') {
  const {json, binary} = chunksOf(data, name);
  const needs = (json.extensionsRequired ?? []).filter(e => e !== 'KHR_mesh_quantization' && !e.startsWith('KHR_materials') &&
                                                            e !== 'KHR_texture_transform' && e !== 'KHR_texture_basisu');
  if (needs.length) throw new Error(`${name} needs ${needs.join(', ')}. Export it without compression.`);
  const damaged = what => new Error(`${name}: ${what} does not exist. Export it again.`);

  const numbers = index => {
    const accessor = json.accessors?.[index];
    if (!accessor) throw damaged(`accessor ${index}`);
    if (accessor.sparse) throw new Error(`${name}: accessor ${index} is sparse. Export it without sparse accessors.`);
    const Type = COMPONENTS[accessor.componentType], width = WIDTHS[accessor.type];
    const slice = json.bufferViews?.[accessor.bufferView];
    if (!Type || !width) throw damaged(`the type of accessor ${index}`);
    if (!slice || slice.buffer !== 0 || !binary) throw damaged(`the buffer of accessor ${index}`);
    const size = Type.BYTES_PER_ELEMENT, stride = slice.byteStride ?? size * width;
    const begin = (slice.byteOffset ?? 0) + (accessor.byteOffset ?? 0);
    const end = accessor.count > 0 ? begin + (accessor.count - 1) * stride + size * width : begin;
    if (!(Number.isInteger(end) && begin >= 0 && end <= binary.length)) throw damaged(`the end of accessor ${index}`);
    const out = new Float64Array(accessor.count * width);
    const view = new DataView(binary.buffer, binary.byteOffset, binary.byteLength);
    const read = 'get' + Type.name.replace('Array', '');
    const most = {Int8Array: 127, Uint8Array: 255, Int16Array: 32767, Uint16Array: 65535}[Type.name];
    for (let i = 0; i < accessor.count; ++i)
      for (let k = 0; k < width; ++k) {
        const value = view[read](begin + i * stride + k * size, true);
        out[i * width + k] = accessor.normalized ? Math.max(-1, value / most) : value;
      }
    return out;
  };

  const positions = [], faces = [];
  const addMesh = (mesh, matrix) => {
    for (const primitive of mesh.primitives ?? []) {
      if ((primitive.mode ?? 4) !== 4 || primitive.attributes?.POSITION === undefined) continue;
      const at = numbers(primitive.attributes.POSITION), first = positions.length / 3;
      for (let i = 0; i < at.length; i += 3)
        for (let r = 0; r < 3; ++r)
          positions.push(matrix[r] * at[i] + matrix[4 + r] * at[i + 1] + matrix[8 + r] * at[i + 2] + matrix[12 + r]);
      const index = primitive.indices === undefined ? Float64Array.from({length: at.length / 3}, (_, i) => i)
                                                    : numbers(primitive.indices);
      for (let i = 0; i + 2 < index.length; i += 3) faces.push(first + index[i], first + index[i + 1], first + index[i + 2]);
    }
  };
  const visited = new Set();
  const visit = (index, parent) => {
    const node = json.nodes?.[index];
    if (!node || visited.has(index)) throw damaged(`node ${index}, or it stands in the scene twice:`);
    visited.add(index);
    const matrix = product(parent, node.matrix ?? matrixOf(node));
    if (node.mesh !== undefined) {
      if (!json.meshes?.[node.mesh]) throw damaged(`mesh ${node.mesh}`);
      addMesh(json.meshes[node.mesh], node.skin === undefined ? matrix : IDENTITY);
    }
    for (const child of node.children ?? []) visit(child, matrix);
  };
  const scene = json.scenes?.[json.scene ?? 0];
  for (const root of scene?.nodes ?? []) visit(root, IDENTITY);
  return checked(positions, faces, name);
}

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

function matrixOf({translation: t = [0, 0, 0], rotation: [x, y, z, w] = [0, 0, 0, 1], scale: s = [1, 1, 1]}) {
  return [s[0] * (1 - 2 * (y * y + z * z)), s[0] * 2 * (x * y + z * w), s[0] * 2 * (x * z - y * w), 0,
          s[1] * 2 * (x * y - z * w), s[1] * (1 - 2 * (x * x + z * z)), s[1] * 2 * (y * z + x * w), 0,
          s[2] * 2 * (x * z + y * w), s[2] * 2 * (y * z - x * w), s[2] * (1 - 2 * (x * x + y * y)), 0,
          t[0], t[1], t[2], 1];
}

/** The product of matrices that are stored column by column. */
function product(a, b) {
  const out = new Array(16).fill(0);
  for (let c = 0; c < 4; ++c)
    for (let r = 0; r < 4; ++r)
      for (let k = 0; k < 4; ++k) out[4 * c + r] += a[4 * k + r] * b[4 * c + k];
  return out;
}
