// White-box: a triangle ruled out wrongly is a wrong distance somewhere that no mesh may happen to ask for.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/triangle.hpp>

#include "leaf_triangles.hpp"

using namespace bodice::geometry;
using bodice::engine::Random;

namespace {

Vec3 random_vector(Random& random, double most) {
  return most * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
}

/// Of any size down to a billionth and any height down to none; corners within the unit cube, as in a tree.
BvhTriangle random_triangle(Random& random) {
  const double size = std::pow(10.0, random.uniform(-9.0, -0.3));
  const double height = random.uniform() < 0.1 ? 0.0 : std::pow(10.0, random.uniform(-12.0, 0.0));
  const Vec3 a = random_vector(random, 0.4), ab = random_vector(random, 0.5 * size);
  return {a, ab, random.uniform(-1.0, 1.0) * ab + height * random_vector(random, 0.5 * size)};
}

/// Near the triangle's surface, its edges' normals or anywhere, down to on it and up to a million away.
Vec3 random_query(Random& random, const BvhTriangle& t) {
  const Vec3 on = t.a + random.uniform(-0.5, 1.5) * t.ab + random.uniform(-0.5, 1.5) * t.ac;
  const double off = random.uniform() < 0.1 ? 0.0 : std::pow(10.0, random.uniform(-9.0, 6.0));
  return on + random_vector(random, off);
}

}  // namespace

TEST_CASE("no triangle of a leaf is nearer than told, by more than the slack") {
  Random random(41);
  double worst = 0.0;
  for (int i = 0; i < 50000; ++i) {
    LeafTriangles leaf{.first = 0, .count = LeafTriangles::kWidth};
    std::array<BvhTriangle, LeafTriangles::kWidth> triangles;
    for (int k = 0; k < LeafTriangles::kWidth; ++k) leaf.set(k, triangles[k] = random_triangle(random));
    const Vec3 query = random_query(random, triangles[0]);
    const Float4 told2 = leaf.distances2(
        {static_cast<float>(query[0]), static_cast<float>(query[1]), static_cast<float>(query[2])});
    const double scale = query.cwiseAbs().maxCoeff() + 1.0;
    for (int k = 0; k < LeafTriangles::kWidth; ++k) {
      const auto& [a, ab, ac] = triangles[k];
      const double distance = (closest_point(a, a + ab, a + ac, query).point - query).norm();
      worst = std::max(worst, (std::sqrt(static_cast<double>(told2[k])) - distance) / scale);
    }
  }
  INFO("worst ", worst / LeafTriangles::kSlack, " of the slack");
  CHECK(worst <= LeafTriangles::kSlack);
  CHECK(worst >= 1e-3 * LeafTriangles::kSlack);  // or the slack is far too wide
}

TEST_CASE("triangles that are well apart are told apart: most need no exact test") {
  Random random(42);
  int told = 0, asked = 0;
  for (int i = 0; i < 1000; ++i) {
    LeafTriangles leaf{.first = 0, .count = 1};
    const Vec3 a = random_vector(random, 0.4);
    const BvhTriangle t{a, random_vector(random, 0.05), random_vector(random, 0.05)};
    leaf.set(0, t);
    const Vec3 query = a + random_vector(random, 0.2);
    const double distance = (closest_point(t.a, t.a + t.ab, t.a + t.ac, query).point - query).norm();
    const Float4 told2 = leaf.distances2(
        {static_cast<float>(query[0]), static_cast<float>(query[1]), static_cast<float>(query[2])});
    ++asked;
    told += std::abs(std::sqrt(static_cast<double>(told2[0])) - distance) < 1e-4;
  }
  CHECK(told == asked);
}
