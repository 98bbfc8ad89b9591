// Colors of vertices, and ellipsoids as triangles.
const PARTS = [[0.86, 0.53, 0.38], [0.40, 0.55, 0.75], [0.55, 0.70, 0.45], [0.78, 0.62, 0.80], [0.93, 0.78, 0.42],
               [0.45, 0.72, 0.72], [0.80, 0.45, 0.50], [0.60, 0.52, 0.80], [0.70, 0.75, 0.35], [0.90, 0.60, 0.65],
               [0.42, 0.62, 0.55], [0.75, 0.55, 0.35], [0.55, 0.65, 0.90], [0.65, 0.45, 0.60], [0.85, 0.70, 0.60]];

/** The error that the colors end at, mm: that of 98 % of the vertices, to one digit. */
export function limitOf(error) {
  const sizes = Float32Array.from(error, Math.abs).sort();
  return Math.max(0.1, Number((sizes[Math.floor(0.98 * (sizes.length - 1))] || 0).toPrecision(1)));
}

export function errorColors(error) {
  const limit = limitOf(error), out = new Float32Array(3 * error.length);
  for (let v = 0; v < error.length; ++v) {
    const t = Math.max(-1, Math.min(1, error[v] / limit)), end = t < 0 ? [0.13, 0.4, 0.8] : [0.8, 0.2, 0.16];
    for (let k = 0; k < 3; ++k) out[3 * v + k] = 0.92 + (end[k] - 0.92) * Math.abs(t);
  }
  return out;
}

export function partColors(parts) {
  const out = new Float32Array(3 * parts.length);
  parts.forEach((part, v) => out.set(PARTS[part % PARTS.length], 3 * v));
  return out;
}

const RING = 24, ROWS = 14;

export function ellipsoidMesh(ellipsoids) {
  const each = (RING + 1) * (ROWS + 1), positions = new Float32Array(3 * each * ellipsoids.length);
  const colors = new Float32Array(positions.length), faces = [];
  ellipsoids.forEach(({center, axes, radii, part}, e) => {
    let v = e * each;
    for (let j = 0; j <= ROWS; ++j)
      for (let i = 0; i <= RING; ++i, ++v) {
        const u = 2 * Math.PI * i / RING, w = Math.PI * j / ROWS;
        const unit = [Math.cos(u) * Math.sin(w), Math.cos(w), Math.sin(u) * Math.sin(w)];
        for (let k = 0; k < 3; ++k)
          positions[3 * v + k] = center[k] + unit.reduce((sum, x, a) => sum + x * radii[a] * axes[a][k], 0);
        colors.set(PARTS[part % PARTS.length], 3 * v);
      }
    for (let j = 0; j < ROWS; ++j)
      for (let i = 0; i < RING; ++i) {
        const a = e * each + j * (RING + 1) + i, b = a + RING + 1;
        faces.push(a, a + 1, b, b, a + 1, b + 1);
      }
  });
  return {positions, faces: Uint32Array.from(faces), colors};
}
