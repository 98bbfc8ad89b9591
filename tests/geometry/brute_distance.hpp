// The distance and the winding number of a mesh by brute force, and a check of MeshDistance against them.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/mesh_distance.hpp>

namespace bodice_test {

using namespace bodice::geometry;
using bodice::engine::Context;
using bodice::engine::Random;

/// The distance to a segment, and to a triangle as the least over its plane and its three segments. It is
/// slow, in long double, and does not share the library's case distinction.
using Long3 = Eigen::Matrix<long double, 3, 1>;

inline long double segment_distance(const Long3& a, const Long3& b, const Long3& p) {
  const Long3 d = b - a;
  const long double length2 = d.squaredNorm();
  const long double t = length2 > 0 ? std::clamp((p - a).dot(d) / length2, 0.0L, 1.0L) : 0.0L;
  return (a + t * d - p).norm();
}

inline long double triangle_distance(const Long3& a, const Long3& b, const Long3& c, const Long3& p) {
  long double best =
      std::min({segment_distance(a, b, p), segment_distance(b, c, p), segment_distance(c, a, p)});
  const Long3 n = (b - a).cross(c - a);
  if (!(n.squaredNorm() > 0)) return best;
  const Long3 projection = p - n * (n.dot(p - a) / n.squaredNorm());
  const bool inside = (b - a).cross(projection - a).dot(n) >= 0 &&
                      (c - b).cross(projection - b).dot(n) >= 0 && (a - c).cross(projection - c).dot(n) >= 0;
  return inside ? std::min(best, (projection - p).norm()) : best;
}

inline double brute_distance(const TriMesh& mesh, const Vec3& query) {
  long double best = INFINITY;
  auto wide = [](const Vec3& v) { return Long3(v.cast<long double>()); };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    best = std::min(best, triangle_distance(wide(mesh.corner(t, 0)), wide(mesh.corner(t, 1)),
                                            wide(mesh.corner(t, 2)), wide(query)));
  return static_cast<double>(best);
}

/// The sum of all solid angles by L'Huilier's theorem, with the sign of the volume. The library uses another
/// formula.
inline double brute_winding(const TriMesh& mesh, const Vec3& query) {
  long double total = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Long3 u[3];
    for (int k = 0; k < 3; ++k) u[k] = (mesh.corner(t, k) - query).cast<long double>().stableNormalized();
    long double side[3];
    for (int k = 0; k < 3; ++k) side[k] = 2 * std::asin(std::min((u[k] - u[(k + 1) % 3]).norm() / 2, 1.0L));
    const long double s = (side[0] + side[1] + side[2]) / 2;
    const long double product = std::tan(s / 2) * std::tan((s - side[0]) / 2) * std::tan((s - side[1]) / 2) *
                                std::tan((s - side[2]) / 2);
    const long double excess = 4 * std::atan(std::sqrt(std::max(product, 0.0L)));
    total += u[0].dot(u[1].cross(u[2])) < 0 ? -excess : excess;
  }
  return static_cast<double>(total / (4 * std::numbers::pi_v<long double>));
}

/// Points near the surface on both sides, in the box, and outside it.
inline std::vector<Vec3> queries_around(const TriMesh& mesh, int count, std::uint64_t seed) {
  Random random(seed);
  Box box;
  for (const Triangle& t : mesh.triangles)
    for (Index v : t) box.extend(mesh.positions[v]);
  const double size = box.size().norm();
  std::vector<Vec3> queries;
  for (int i = 0; i < count; ++i) {
    const std::size_t t = random.below(mesh.triangles.size());
    const Vec3 n = area_vector(mesh, t).stableNormalized();
    const double u = random.uniform();
    const double v = random.uniform() * (1.0 - u);
    const Vec3 on = mesh.corner(t, 0) + u * (mesh.corner(t, 1) - mesh.corner(t, 0)) +
                    v * (mesh.corner(t, 2) - mesh.corner(t, 0));
    const double off = size * std::pow(10.0, random.uniform(-7.0, 0.3));
    queries.push_back(on + (random.uniform() < 0.5 ? off : -off) * n);
    Vec3 anywhere;
    for (int k = 0; k < 3; ++k) anywhere[k] = box.center()[k] + 0.6 * size * random.uniform(-1.0, 1.0);
    queries.push_back(anywhere);
  }
  return queries;
}

inline void check_against_brute_force(const MeshDistance& distance, const TriMesh& mesh, int count) {
  const double size = bounding_box(mesh.positions).size().norm();
  const double noise = 1e-13 * (size + bounding_box(mesh.positions).center().norm());
  for (const Vec3& query : queries_around(mesh, count, 17)) {
    CAPTURE(query);
    const SurfacePoint got = distance.closest_point(query);
    const double truth = brute_distance(mesh, query);
    REQUIRE(std::abs(std::abs(got.signed_distance) - truth) <= noise + 1e-13 * truth);
    CHECK(std::abs((got.point - query).norm() - truth) <= noise + 1e-13 * truth);
    REQUIRE(got.triangle < mesh.triangles.size());
    const double winding = brute_winding(mesh, query);
    CHECK(std::abs(distance.winding_number(query) - winding) < 0.01);
    if (std::abs(winding - 0.5) > 0.02 && truth > noise) {
      CHECK((got.signed_distance < 0.0) == (winding > 0.5));
      CHECK(distance.inside(query) == (winding > 0.5));
    }
    if (std::abs(winding - 1.5) > 0.02 && truth > noise)
      CHECK(distance.winds_more_than(1.5, query) == (winding > 1.5));
    const auto within = distance.closest_point_within(query, truth * (1.0 + 1e-12) + 2.0 * noise);
    REQUIRE(within);
    CHECK(std::abs(within->signed_distance - truth) <= noise + 1e-13 * truth);
    CHECK_FALSE(distance.closest_point_within(query, truth * (1.0 - 1e-12) - 2.0 * noise));
  }
}

inline void check_against_brute_force(const TriMesh& mesh, int count) {
  check_against_brute_force(MeshDistance(Context{}, mesh), mesh, count);
}

}  // namespace bodice_test
