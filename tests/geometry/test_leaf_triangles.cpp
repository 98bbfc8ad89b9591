// White-box: a triangle ruled out wrongly is a wrong distance at points that no mesh test may happen to
// query.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/triangle.hpp>

#include "distance/leaf_triangles.hpp"
#include "shape/solid_angle.hpp"

using namespace bodice::geometry;
using bodice::engine::Random;

namespace {

Vec3 random_vector(Random& random, double most) {
  return most * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
}

/// A triangle of any size down to a billionth and any height down to none, inside the unit cube as in a tree.
BvhTriangle random_triangle(Random& random) {
  const double size = std::pow(10.0, random.uniform(-9.0, -0.3));
  const double height = random.uniform() < 0.1 ? 0.0 : std::pow(10.0, random.uniform(-12.0, 0.0));
  const Vec3 a = random_vector(random, 0.4), ab = random_vector(random, 0.5 * size);
  return {a, ab, random.uniform(-1.0, 1.0) * ab + height * random_vector(random, 0.5 * size)};
}

/// A query near the triangle's surface, along its edges' normals, or anywhere; from on it to a million away.
Vec3 random_query(Random& random, const BvhTriangle& t) {
  const Vec3 on = t.a + random.uniform(-0.5, 1.5) * t.ab + random.uniform(-0.5, 1.5) * t.ac;
  const double off = random.uniform() < 0.1 ? 0.0 : std::pow(10.0, random.uniform(-9.0, 6.0));
  return on + random_vector(random, off);
}

}  // namespace

TEST_CASE("a leaf overestimates no distance by more than the slack") {
  Random random(41);
  double worst = 0.0;
  for (int i = 0; i < 50000; ++i) {
    LeafTriangles leaf{.first = 0, .count = LeafTriangles::kWidth};
    std::array<BvhTriangle, LeafTriangles::kWidth> triangles;
    for (int k = 0; k < LeafTriangles::kWidth; ++k) leaf.set(k, triangles[k] = random_triangle(random));
    const Vec3 query = random_query(random, triangles[0]);
    const Float4 estimate2 = leaf.distances2(
        {static_cast<float>(query[0]), static_cast<float>(query[1]), static_cast<float>(query[2])});
    const double scale = query.cwiseAbs().maxCoeff() + 1.0;
    for (int k = 0; k < LeafTriangles::kWidth; ++k) {
      const auto& [a, ab, ac] = triangles[k];
      const double distance = (closest_point(a, a + ab, a + ac, query).point - query).norm();
      worst = std::max(worst, (std::sqrt(static_cast<double>(estimate2[k])) - distance) / scale);
    }
  }
  INFO("worst ", worst / LeafTriangles::kSlack, " of the slack");
  CHECK(worst <= LeafTriangles::kSlack);
  CHECK(worst >= 1e-3 * LeafTriangles::kSlack);  // otherwise the slack is far too wide
}

TEST_CASE("a leaf gives distances to 0.1 mm for triangles within a meter that are no slivers") {
  Random random(42);
  int close = 0, count = 0;
  for (int i = 0; i < 1000; ++i) {
    LeafTriangles leaf{.first = 0, .count = 1};
    const Vec3 a = random_vector(random, 0.4);
    const BvhTriangle t{a, random_vector(random, 0.05), random_vector(random, 0.05)};
    leaf.set(0, t);
    const Vec3 query = a + random_vector(random, 0.2);
    const double distance = (closest_point(t.a, t.a + t.ab, t.a + t.ac, query).point - query).norm();
    const Float4 estimate2 = leaf.distances2(
        {static_cast<float>(query[0]), static_cast<float>(query[1]), static_cast<float>(query[2])});
    ++count;
    close += std::abs(std::sqrt(static_cast<double>(estimate2[0])) - distance) < 1e-4;
  }
  CHECK(close == count);
}

TEST_CASE("a leaf gives half of each solid angle, or reports that a point nearly lies in a triangle") {
  Random random(43);
  int known = 0;
  for (int i = 0; i < 20000; ++i) {
    LeafTriangles leaf{.first = 0, .count = 3};
    std::array<BvhTriangle, 3> triangles;
    for (int k = 0; k < 3; ++k) {
      triangles[static_cast<std::size_t>(k)] = {random_vector(random, 0.4), random_vector(random, 0.1),
                                                random_vector(random, 0.1)};
      leaf.set(k, triangles[static_cast<std::size_t>(k)]);
    }
    const BvhTriangle& in = triangles[0];
    const double u = random.uniform(-0.2, 1.2), v = random.uniform(-0.2, 1.2);
    const double height = (i % 2 ? 1.0 : -1.0) * std::pow(10.0, random.uniform(-9.0, -1.0));
    const Vec3 on = in.a + u * in.ab + v * in.ac, normal = in.ab.cross(in.ac).normalized();
    const Eigen::Vector3f at = (on + height * normal).cast<float>();
    const Vec3 query = at.cast<double>();
    Int4 near{};
    const Float4 half = leaf.half_solid_angles({at.x(), at.y(), at.z()}, near);
    CHECK(half[3] == 0.0f);  // an empty lane
    CHECK(near[3] == 0);
    for (std::size_t k = 0; k < 3; ++k) {
      const BvhTriangle& t = triangles[k];
      const HalfAngle exact = half_solid_angle(t.a, t.a + t.ab, t.a + t.ac, query);
      const double distance = (closest_point(t.a, t.a + t.ab, t.a + t.ac, query).point - query).norm();
      const bool is_near = near[static_cast<int>(k)] != 0;
      if (distance < 1e-7) CHECK(is_near);
      if (std::abs(t.ab.cross(t.ac).normalized().dot(query - t.a)) > 1e-5) CHECK_FALSE(is_near);
      if (is_near) continue;
      ++known;
      // Coordinates are rounded by about 1e-7, which turns the triangle by as much over the distance.
      CHECK(std::abs(static_cast<double>(half[static_cast<int>(k)]) - std::atan2(exact.sine, exact.cosine)) <
            3e-5 + 3e-7 / distance);
    }
  }
  CHECK(known > 50000);
}
