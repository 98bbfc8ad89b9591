// Triangles that cross, against a solution of linear equations for each edge and triangle.
#include <doctest/doctest.h>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/crossings.hpp>

using namespace bodice;
using geometry::Triangle;
using geometry::Vec3;

namespace {

using Pairs = std::vector<std::array<std::size_t, 2>>;

// Whether the point of the line through p and q on the plane of a, b and c is inside both.
bool meets(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  geometry::Mat3 columns;
  columns << b - a, c - a, p - q;
  const Vec3 x = columns.fullPivLu().solve(p - a);
  return x[0] > 0.0 && x[1] > 0.0 && x[0] + x[1] < 1.0 && x[2] > 0.0 && x[2] < 1.0;
}

Pairs by_equations(const std::vector<Vec3>& at, const std::vector<Triangle>& triangles) {
  Pairs found;
  const auto any_edge = [&](const Triangle& s, const Triangle& t) {
    for (std::size_t k = 0; k < 3; ++k)
      if (meets(at[s[k]], at[s[(k + 1) % 3]], at[t[0]], at[t[1]], at[t[2]])) return true;
    return false;
  };
  for (std::size_t s = 0; s < triangles.size(); ++s)
    for (std::size_t t = s + 1; t < triangles.size(); ++t)
      if (any_edge(triangles[s], triangles[t]) || any_edge(triangles[t], triangles[s]))
        found.push_back({s, t});
  return found;
}

}  // namespace

TEST_CASE("crossings: those of a soup of triangles are the ones that equations find") {
  engine::Random random(7);
  std::vector<Vec3> at;
  std::vector<Triangle> triangles;
  for (geometry::Index t = 0; t < 120; ++t) {
    const Vec3 middle(random.uniform(), random.uniform(), random.uniform());
    for (int k = 0; k < 3; ++k)
      at.push_back(middle + 0.5 * Vec3(random.uniform(), random.uniform(), random.uniform()));
    triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const Pairs found = geometry::find_crossings(at, triangles);
  CHECK(found.size() > 50);
  CHECK(found == by_equations(at, triangles));
}

TEST_CASE("crossings: neighbors, triangles that touch, and positions that are not finite cross nothing") {
  const std::vector<Vec3> at = {Vec3(0, 0, 0),     Vec3(1, 0, 0),
                                Vec3(0, 1, 0),     Vec3(1, 1, 0),
                                Vec3(0.2, 0.2, 0), Vec3(0.2, 0.2, 1),
                                Vec3(0.5, 0.2, 1), Vec3(0.2, 0.2, std::numeric_limits<double>::quiet_NaN())};
  CHECK(geometry::find_crossings(at, std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}).empty());
  CHECK(geometry::find_crossings(at, std::vector<Triangle>{{0, 1, 2}, {4, 5, 6}}).empty());
  CHECK(geometry::find_crossings(at, std::vector<Triangle>{{0, 1, 2}, {4, 7, 6}}).empty());
  std::vector<Vec3> through = at;
  through[4].z() = -0.1;
  CHECK(geometry::find_crossings(through, std::vector<Triangle>{{0, 1, 2}, {4, 5, 6}}) == Pairs{{0, 1}});
}
