// Based on: Christer Ericson. Real-Time Collision Detection. 2005. - section 5.1.5 (Voronoi regions).
// Based on: Adriaan van Oosterom, Jan Strackee. The Solid Angle of a Plane Triangle. 1983. - eq. (8)
#include <algorithm>
#include <cmath>

#include <bodice/geometry/triangle.hpp>

namespace bodice::geometry {
namespace {

// Squared sine of the angle at a, below which the weights of the face lose half of their digits: the face's
// point is then held against the edges'.
constexpr double kSliver2 = 1e-16;

TrianglePoint on_vertex(const Vec3& p, int k) {
  return {p, Vec3::Unit(k), static_cast<TriangleFeature>(static_cast<int>(TriangleFeature::kVertex0) + k)};
}

/// The nearest point of edge k (corner k to corner k + 1).
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

/// For slivers, where the Voronoi regions of the face drown in rounding.
TrianglePoint nearest_edge(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& query) {
  TrianglePoint best = on_edge(a, b, 0, query);
  for (const TrianglePoint& other : {on_edge(b, c, 1, query), on_edge(c, a, 2, query)})
    if ((other.point - query).squaredNorm() < (best.point - query).squaredNorm()) best = other;
  return best;
}

}  // namespace

TrianglePoint closest_point(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& query) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 ap = query - a;
  const Vec3 normal = ab.cross(ac);
  const double area2 = normal.squaredNorm();
  // Barycentric weights of the projection, from the areas of the three sub-triangles.
  const double v = ap.cross(ac).dot(normal);
  const double w = ab.cross(ap).dot(normal);
  if (!(v > 0.0 && w > 0.0 && v + w < area2)) return nearest_edge(a, b, c, query);
  const double inv = 1.0 / area2;
  const TrianglePoint face{a + (v * inv) * ab + (w * inv) * ac, Vec3(1.0 - (v + w) * inv, v * inv, w * inv),
                           TriangleFeature::kFace};
  if (area2 > kSliver2 * ab.squaredNorm() * ac.squaredNorm()) return face;
  const TrianglePoint edge = nearest_edge(a, b, c, query);
  return (edge.point - query).squaredNorm() < (face.point - query).squaredNorm() ? edge : face;
}

double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& apex) {
  const Vec3 u = a - apex;
  const Vec3 v = b - apex;
  const Vec3 w = c - apex;
  const double lu = u.norm();
  const double lv = v.norm();
  const double lw = w.norm();
  const double numerator = u.dot(v.cross(w));
  const double denominator = lu * lv * lw + u.dot(v) * lw + v.dot(w) * lu + w.dot(u) * lv;
  return numerator == 0.0 ? 0.0 : 2.0 * std::atan2(numerator, denominator);
}

}  // namespace bodice::geometry
