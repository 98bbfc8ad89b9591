#include "distance/leaf_triangles.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace bodice::geometry {
namespace {

// Triangles lower than this, in local units, are never ruled out, since their planes are not known well
// enough.
constexpr double kLeastHeight = 1e-6;

Float4 unit_interval(Float4 t) {
  return min(max(t, Float4{}), Float4{} + 1.0f);
}

Float4 squared_norm(Float4 x, Float4 y) {
  return x * x + y * y;
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
  const Float4 dx = point[0] - a[0], dy = point[1] - a[1], dz = point[2] - a[2];
  const Float4 u = dx * x[0] + dy * x[1] + dz * x[2];
  const Float4 v = dx * y[0] + dy * y[1] + dz * y[2];
  const Float4 w =
      dx * (x[1] * y[2] - x[2] * y[1]) + dy * (x[2] * y[0] - x[0] * y[2]) + dz * (x[0] * y[1] - x[1] * y[0]);
  const Float4 bu = u - bx, bc = cx - bx;  // from b, and from b to c
  const Float4 on_ac = unit_interval((u * cx + v * cy) * per_ac2);
  const Float4 on_bc = unit_interval((bu * bc + v * cy) * per_bc2);
  const Float4 to_edges =
      min(squared_norm(u - max(min(u, bx), Float4{}), v),
          min(squared_norm(u - on_ac * cx, v - on_ac * cy), squared_norm(bu - on_bc * bc, v - on_bc * cy)));
  const Int4 above = (v >= 0.0f) & (u * cy >= v * cx) & (v * bc >= bu * cy);
  return (above ? Float4{} : to_edges) + w * w;
}

}  // namespace bodice::geometry
