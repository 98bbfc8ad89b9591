// The fixed-cost foot: t is the root of |w(t)| = 1, w_j = r_j y_j / (t + r_j^2), by three Newton steps on
// 1/|w| from a lower bound (each step stays a lower bound, because 1/|w| is concave). Based on: David Eberly.
// Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid. 2013. Differs: fixed number of
// steps in float, without branches, so that compilers vectorise over the points.
#include "foot_batch.hpp"

#include "vector_clones.hpp"

namespace bodice::fitting {
namespace {

// Own one-liners: functions compiled under other flags than these would not be inlined.
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

struct Foot {
  float d, wx, wy, wz;
};

[[gnu::always_inline]] inline Foot foot(const FootEllipsoid& e, float px, float py, float pz) {
  constexpr float kTiny = 1e-18f;
  const float dx = px - e.c[0], dy = py - e.c[1], dz = pz - e.c[2];
  const float y0 = e.rt[0][0] * dx + e.rt[0][1] * dy + e.rt[0][2] * dz;
  const float y1 = e.rt[1][0] * dx + e.rt[1][1] * dy + e.rt[1][2] * dz;
  const float y2 = e.rt[2][0] * dx + e.rt[2][1] * dy + e.rt[2][2] * dz;
  const float q0 = e.r[0] * e.r[0], q1 = e.r[1] * e.r[1], q2 = e.r[2] * e.r[2];
  const float a0 = e.r[0] * y0, a1 = e.r[1] * y1, a2 = e.r[2] * y2;
  const float qmax = larger(q0, larger(q1, q2)), qmin = smaller(q0, smaller(q1, q2));
  const float axis = larger(magnitude(a0) - q0, larger(magnitude(a1) - q1, magnitude(a2) - q2));
  float t = root(a0 * a0 + a1 * a1 + a2 * a2) - qmax;
  t = larger(larger(t, axis), -0.9999f * qmin);
  for (int step = 0; step < 3; ++step) {
    const float i0 = 1.0f / (t + q0), i1 = 1.0f / (t + q1), i2 = 1.0f / (t + q2);
    const float w0 = a0 * i0, w1 = a1 * i1, w2 = a2 * i2;
    const float ww = w0 * w0 + w1 * w1 + w2 * w2 + kTiny;
    const float slope = w0 * w0 * i0 + w1 * w1 * i1 + w2 * w2 * i2 + kTiny;
    t = larger(t + (root(ww) - 1.0f) * ww / slope, -0.9999f * qmin);
  }
  float w0 = a0 / (t + q0), w1 = a1 / (t + q1), w2 = a2 / (t + q2);
  const float scale = 1.0f / root(w0 * w0 + w1 * w1 + w2 * w2 + kTiny);
  w0 *= scale, w1 *= scale, w2 *= scale;
  const float n0 = w0 / e.r[0], n1 = w1 / e.r[1], n2 = w2 / e.r[2];
  const float along = n0 * (y0 - e.r[0] * w0) + n1 * (y1 - e.r[1] * w1) + n2 * (y2 - e.r[2] * w2);
  return {along / root(n0 * n0 + n1 * n1 + n2 * n2 + kTiny), w0, w1, w2};
}

}  // namespace

BODICE_CLONES void foot_distances(const FootEllipsoid& ellipsoid, std::size_t n, const float* __restrict x,
                                  const float* __restrict y, const float* __restrict z, float* __restrict d) {
  const FootEllipsoid e = ellipsoid;
  for (std::size_t i = 0; i < n; ++i) d[i] = foot(e, x[i], y[i], z[i]).d;
}

BODICE_CLONES void foot_details(const FootEllipsoid& ellipsoid, std::size_t n, const float* __restrict x,
                                const float* __restrict y, const float* __restrict z, float* __restrict d,
                                float* __restrict wx, float* __restrict wy, float* __restrict wz) {
  const FootEllipsoid e = ellipsoid;
  for (std::size_t i = 0; i < n; ++i) {
    const Foot f = foot(e, x[i], y[i], z[i]);
    d[i] = f.d;
    wx[i] = f.wx;
    wy[i] = f.wy;
    wz[i] = f.wz;
  }
}

}  // namespace bodice::fitting
