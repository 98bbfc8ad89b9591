// Based on: David Eberly. Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid. 2013.
// Derivation: modules/geometry/README.md, equations (1) to (6), here in t in place of u.
// The closest point of y has the direction w(t), w_j = r_j y_j / (t + r_j^2), at the root t of |w(t)| = 1.
// Newton steps on 1/|w| start from a lower bound, and each step stays a lower bound, because 1/|w| is
// concave. All is multiplied by (t + r_0^2)(t + r_1^2)(t + r_2^2), so that a step costs one division.
// Differs: three steps in float, without branches, so that compilers vectorize over the points.
#include "base/closest_point_batch.hpp"

#include "base/vector_clones.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

// These stand in for std functions, which are compiled under other flags and would not be inlined.
[[gnu::always_inline]] inline float larger(float a, float b) {
  return a < b ? b : a;
}
[[gnu::always_inline]] inline float smaller(float a, float b) {
  return b < a ? b : a;
}
[[gnu::always_inline]] inline float magnitude(float a) {
  return __builtin_fabsf(a);
}
[[gnu::always_inline]] inline float root(float a) {
  return __builtin_sqrtf(a);
}

/// The closest point of one point.
struct Closest {
  float d, wx, wy, wz;  // signed distance; direction w on the unit sphere
  float nx, ny, nz;     // outward normal of length 1 / per_length, in the ellipsoid's frame
  float per_length;
};

[[gnu::always_inline]] inline Closest closest(const FloatEllipsoid& e, float px, float py, float pz) {
  constexpr float kTiny = 1e-36f;                    // keeps divisors off zero
  const float least_t = -0.9999f * e.least_squared;  // a point inside has its root above this
  const float dx = px - e.c[0], dy = py - e.c[1], dz = pz - e.c[2];
  const float y0 = e.to_unit[0][0] * dx + e.to_unit[0][1] * dy + e.to_unit[0][2] * dz;
  const float y1 = e.to_unit[1][0] * dx + e.to_unit[1][1] * dy + e.to_unit[1][2] * dz;
  const float y2 = e.to_unit[2][0] * dx + e.to_unit[2][1] * dy + e.to_unit[2][2] * dz;
  const float a0 = e.unit[0] * y0, a1 = e.unit[1] * y1, a2 = e.unit[2] * y2;
  const float axis = larger(magnitude(a0) - e.squared[0],
                            larger(magnitude(a1) - e.squared[1], magnitude(a2) - e.squared[2]));
  float t = root(a0 * a0 + a1 * a1 + a2 * a2) - e.most_squared;
  t = larger(larger(t, axis), least_t);
  for (int step = 0; step < 3; ++step) {
    const float s0 = t + e.squared[0], s1 = t + e.squared[1], s2 = t + e.squared[2];
    const float p0 = s1 * s2, p1 = s2 * s0, p2 = s0 * s1;
    const float v0 = a0 * p0, v1 = a1 * p1, v2 = a2 * p2;  // w times s0 s1 s2
    const float vv = v0 * v0 + v1 * v1 + v2 * v2;
    const float slope = v0 * v0 * p0 + v1 * v1 * p1 + v2 * v2 * p2 + kTiny;
    t = larger(t + (root(vv) - s0 * p0) * vv / slope, least_t);
  }
  const float s0 = t + e.squared[0], s1 = t + e.squared[1], s2 = t + e.squared[2];
  float w0 = a0 * (s1 * s2), w1 = a1 * (s2 * s0), w2 = a2 * (s0 * s1);
  const float scale = 1.0f / root(w0 * w0 + w1 * w1 + w2 * w2 + kTiny);
  w0 *= scale, w1 *= scale, w2 *= scale;
  const float n0 = w0 * e.inverse[0], n1 = w1 * e.inverse[1], n2 = w2 * e.inverse[2];
  const float along = n0 * (y0 - e.unit[0] * w0) + n1 * (y1 - e.unit[1] * w1) + n2 * (y2 - e.unit[2] * w2);
  const float length = root(n0 * n0 + n1 * n1 + n2 * n2 + kTiny);
  return {e.largest * along / length, w0, w1, w2, n0, n1, n2, 1.0f / length};
}

}  // namespace

FloatEllipsoid::FloatEllipsoid(const geometry::Ellipsoid& e)
    : largest(static_cast<float>(e.radii.maxCoeff())) {
  for (int j = 0; j < 3; ++j) {
    c[j] = static_cast<float>(e.center[j]);
    r[j] = static_cast<float>(e.radii[j]);
    unit[j] = r[j] / largest;
    squared[j] = unit[j] * unit[j];
    inverse[j] = largest / r[j];
    for (int i = 0; i < 3; ++i) {
      rt[j][i] = static_cast<float>(e.axes(i, j));
      to_unit[j][i] = rt[j][i] / largest;
    }
  }
  most_squared = larger(squared[0], larger(squared[1], squared[2]));
  least_squared = smaller(squared[0], smaller(squared[1], squared[2]));
}

BODICE_CLONES void batch_distances(const FloatEllipsoid& ellipsoid, const PointArrays& points,
                                   float* __restrict d) {
  const FloatEllipsoid e = ellipsoid;
  const auto [n, x, y, z] = points;
  for (std::size_t i = 0; i < n; ++i) d[i] = closest(e, x[i], y[i], z[i]).d;
}

BODICE_CLONES void batch_normals(const FloatEllipsoid& ellipsoid, const PointArrays& points,
                                 float* __restrict d, float* __restrict nx, float* __restrict ny,
                                 float* __restrict nz) {
  const FloatEllipsoid e = ellipsoid;
  const auto [n, x, y, z] = points;
  for (std::size_t i = 0; i < n; ++i) {
    const Closest f = closest(e, x[i], y[i], z[i]);
    d[i] = f.d;
    nx[i] = f.per_length * (e.rt[0][0] * f.nx + e.rt[1][0] * f.ny + e.rt[2][0] * f.nz);
    ny[i] = f.per_length * (e.rt[0][1] * f.nx + e.rt[1][1] * f.ny + e.rt[2][1] * f.nz);
    nz[i] = f.per_length * (e.rt[0][2] * f.nx + e.rt[1][2] * f.ny + e.rt[2][2] * f.nz);
  }
}

BODICE_CLONES void batch_directions(const FloatEllipsoid& ellipsoid, const PointArrays& points,
                                    float* __restrict wx, float* __restrict wy, float* __restrict wz) {
  const FloatEllipsoid e = ellipsoid;
  const auto [n, x, y, z] = points;
  for (std::size_t i = 0; i < n; ++i) {
    const Closest f = closest(e, x[i], y[i], z[i]);
    wx[i] = f.wx;
    wy[i] = f.wy;
    wz[i] = f.wz;
  }
}

}  // namespace bodice::fitting
