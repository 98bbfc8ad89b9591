// Based on: Adriaan van Oosterom, Jan Strackee. The Solid Angle of a Plane Triangle. 1983. - eq. (8)
// Based on: Milton Abramowitz, Irene A. Stegun. Handbook of Mathematical Functions. 1964. - 4.4.47, the arc
// tangent
#include "distance/leaf_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace bodice::inline v0_1::geometry {
namespace {

// Triangles lower than this, in local units, are never ruled out, since their planes are not known well
// enough.
constexpr double kLeastHeight = 1e-6;

// A point nearer to a triangle's plane than this, in local units, may lie on either side of it in floats.
constexpr float kKnownSide = 16.0f * 0x1p-23f;

Float4 unit_interval(Float4 t) {
  return min(max(t, Float4{}), Float4{} + 1.0f);
}

Float4 squared_norm(Float4 x, Float4 y) {
  return x * x + y * y;
}

Float4 absolute(Float4 a) {
  return max(a, -a);
}

/// A point in the frames of the triangles: along the first edge, across it in the plane, and off the plane.
struct InPlanes {
  Float4 u, v, w;
};

InPlanes in_planes(const LeafTriangles& leaf, const std::array<float, 3>& point) {
  const std::array<Float4, 3>&x = leaf.x, &y = leaf.y;
  const Float4 dx = point[0] - leaf.a[0], dy = point[1] - leaf.a[1], dz = point[2] - leaf.a[2];
  return {
      dx * x[0] + dy * x[1] + dz * x[2], dx * y[0] + dy * y[1] + dz * y[2],
      dx * (x[1] * y[2] - x[2] * y[1]) + dy * (x[2] * y[0] - x[0] * y[2]) + dz * (x[0] * y[1] - x[1] * y[0])};
}

/// The angle of (cosine, sine), which may be scaled by a common positive factor, within 2e-5; 0 where both
/// are 0.
Float4 angle_of(Float4 cosine, Float4 sine) {
  constexpr auto kPi = static_cast<float>(std::numbers::pi);
  const Float4 s = absolute(sine), c = absolute(cosine), most = max(s, c);
  const Float4 t = min(s, c) / (most > 0.0f ? most : Float4{} + 1.0f), t2 = t * t;
  const Float4 eighth =
      t * (0.9998660f + t2 * (-0.3302995f + t2 * (0.1801410f + t2 * (-0.0851330f + t2 * 0.0208351f))));
  const Float4 quarter = s > c ? 0.5f * kPi - eighth : eighth;
  const Float4 half = cosine < 0.0f ? kPi - quarter : quarter;
  return sine < 0.0f ? -half : half;
}

}  // namespace

void LeafTriangles::set(int slot, const BvhTriangle& t) {
  const Vec3 bc = t.ac - t.ab, normal = t.ab.cross(t.ac);
  const double ab2 = t.ab.squaredNorm(), ac2 = t.ac.squaredNorm(), bc2 = bc.squaredNorm();
  for (int k = 0; k < 3; ++k) a[k][slot] = static_cast<float>(t.a[k]);
  if (!(normal.squaredNorm() > kLeastHeight * kLeastHeight * std::max({ab2, ac2, bc2}))) return;
  const Vec3 along = t.ab / std::sqrt(ab2), across = normal.cross(t.ab).normalized();
  for (int k = 0; k < 3; ++k) {
    x[k][slot] = static_cast<float>(along[k]);
    y[k][slot] = static_cast<float>(across[k]);
  }
  bx[slot] = static_cast<float>(along.dot(t.ab));
  cx[slot] = static_cast<float>(along.dot(t.ac));
  cy[slot] = static_cast<float>(across.dot(t.ac));
  per_ac2[slot] = static_cast<float>(1.0 / ac2);
  per_bc2[slot] = static_cast<float>(1.0 / bc2);
}

Float4 LeafTriangles::distances2(const std::array<float, 3>& point) const {
  const auto [u, v, w] = in_planes(*this, point);
  const Float4 bu = u - bx, bc = cx - bx;  // from b, and from b to c
  const Float4 on_ac = unit_interval((u * cx + v * cy) * per_ac2);
  const Float4 on_bc = unit_interval((bu * bc + v * cy) * per_bc2);
  const Float4 to_edges =
      min(squared_norm(u - max(min(u, bx), Float4{}), v),
          min(squared_norm(u - on_ac * cx, v - on_ac * cy), squared_norm(bu - on_bc * bc, v - on_bc * cy)));
  const Int4 above = (v >= 0.0f) & (u * cy >= v * cx) & (v * bc >= bu * cy);
  return (above ? Float4{} : to_edges) + w * w;
}

Float4 LeafTriangles::half_solid_angles(const std::array<float, 3>& point, Int4& near) const {
  const auto [u, v, w] = in_planes(*this, point);
  const Float4 bu = u - bx, cu = u - cx, cv = v - cy, w2 = w * w;
  near |= (bx > 0.0f) & (absolute(w) < kKnownSide) & (v > -kKnownSide) & (cv < kKnownSide) &
          (max(u, max(bu, cu)) > -kKnownSide) & (min(u, min(bu, cu)) < kKnownSide);
  const Float4 to_a = square_root(squared_norm(u, v) + w2), to_b = square_root(squared_norm(bu, v) + w2),
               to_c = square_root(squared_norm(cu, cv) + w2);
  const Float4 cosine = to_a * to_b * to_c + (u * bu + v * v + w2) * to_c + (bu * cu + v * cv + w2) * to_a +
                        (cu * u + cv * v + w2) * to_b;
  return angle_of(cosine, -w * bx * cy);
}

}  // namespace bodice::geometry
