// Based on: Christer Ericson. Real-Time Collision Detection. 2005. - section 5.1.5 (Voronoi regions).
#include <algorithm>
#include <cmath>
#include <limits>

#include <bodice/geometry/triangle.hpp>

#include "shape/solid_angle.hpp"

namespace bodice::inline v0_1::geometry {
namespace {

// Squared sine of the angle at a below which the weights of the face lose half of their digits. Such a face's
// point is compared with those of the edges.
constexpr double kSliver2 = 1e-16;

TrianglePoint on_vertex(const Vec3& p, int k) {
  return {p, Vec3::Unit(k), static_cast<TriangleFeature>(static_cast<int>(TriangleFeature::kVertex0) + k)};
}

/// The closest point of edge k (corner k to corner k + 1).
TrianglePoint on_edge(const Vec3& from, const Vec3& to, int k, const Vec3& query) {
  const Vec3 along = to - from;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0.0 ? (query - from).dot(along) / length2 : 0.0;
  if (!(t > 0.0)) return on_vertex(from, k);
  if (t >= 1.0) return on_vertex(to, (k + 1) % 3);
  TrianglePoint result{from + t * along, Vec3::Zero(),
                       static_cast<TriangleFeature>(static_cast<int>(TriangleFeature::kEdge01) + k)};
  result.barycentric[k] = 1.0 - t;
  result.barycentric[(k + 1) % 3] = t;
  return result;
}

/// The closest point of the edges in `mask` (bit k: corner k to corner k + 1), which holds at least one.
TrianglePoint nearest_edge(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& query, unsigned mask) {
  const Vec3* corners[] = {&a, &b, &c, &a};
  TrianglePoint best;
  double best2 = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    if ((mask >> k & 1u) == 0) continue;
    const TrianglePoint at = on_edge(*corners[k], *corners[k + 1], k, query);
    const double distance2 = (at.point - query).squaredNorm();
    if (!(distance2 >= best2)) {
      best2 = distance2;
      best = at;
    }
  }
  return best;
}

}  // namespace

TrianglePoint closest_point(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& query) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 ap = query - a;
  const Vec3 normal = ab.cross(ac);
  const double area2 = normal.squaredNorm();
  // The barycentric weights of the projection are the areas of the three sub-triangles.
  const double v = ap.cross(ac).dot(normal);
  const double w = ab.cross(ap).dot(normal);
  // The closest point lies on an edge that separates the projection from the face. In slivers the signs are
  // noise, so that all three edges are tested.
  const bool sliver = !(area2 > kSliver2 * ab.squaredNorm() * ac.squaredNorm());
  const unsigned beyond = (w > 0.0 ? 0u : 1u) | (v + w < area2 ? 0u : 2u) | (v > 0.0 ? 0u : 4u);
  if (beyond != 0) return nearest_edge(a, b, c, query, sliver ? 7u : beyond);
  const double inv = 1.0 / area2;
  const TrianglePoint face{a + (v * inv) * ab + (w * inv) * ac, Vec3(1.0 - (v + w) * inv, v * inv, w * inv),
                           TriangleFeature::kFace};
  if (!sliver) return face;
  const TrianglePoint edge = nearest_edge(a, b, c, query, 7u);
  return (edge.point - query).squaredNorm() < (face.point - query).squaredNorm() ? edge : face;
}

double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& apex) {
  const HalfAngle half = half_solid_angle(a, b, c, apex);
  return half.sine == 0.0 ? 0.0 : 2.0 * std::atan2(half.sine, half.cosine);
}

}  // namespace bodice::geometry
