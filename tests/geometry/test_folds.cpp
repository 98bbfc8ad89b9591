// Triangles that lie folded over their neighbors are counted and evened out along the surface.
#include <doctest/doctest.h>

#include <cmath>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/folds.hpp>
#include <bodice_test/shapes.hpp>

using namespace bodice;
using namespace bodice::geometry;

namespace {

/// A ball with edges of some 35 mm. Its vertices were moved along it by 20 mm in each direction.
TriMesh folded_ball() {
  TriMesh ball = bodice_test::icosphere(1.0, 5);
  engine::Random random(5, 1);
  for (Vec3& p : ball.positions)
    p = (p + 0.02 * Vec3(random.normal(), random.normal(), random.normal())).normalized();
  return ball;
}

}  // namespace

TEST_CASE("folded triangles of a ball are evened out, and its vertices stay on it") {
  TriMesh ball = folded_ball();
  const double before = folded_share(ball);
  CHECK(before > 0.1);
  ball.positions = without_folds({}, ball);
  CHECK(folded_share(ball) < 0.05 * before);
  double farthest = 0.0;
  for (const Vec3& p : ball.positions) farthest = std::max(farthest, std::abs(p.norm() - 1.0));
  CHECK(farthest < 0.004);
}

TEST_CASE("clean and empty surfaces have no folds, and rims stay where they are") {
  CHECK(folded_share({}) == 0.0);
  CHECK(without_folds({}, {}).empty());
  CHECK(folded_share(bodice_test::icosphere(1.0, 3)) == 0.0);
  TriMesh half = folded_ball();
  std::erase_if(half.triangles, [&](const Triangle& t) { return half.positions[t[0]].x() > 0.0; });
  const std::vector<Vec3> even = without_folds({}, half);
  std::vector<int> triangles(half.positions.size());
  for (const Triangle& t : half.triangles)
    for (const Index v : t) ++triangles[v];
  std::size_t kept = 0, moved = 0;
  for (std::size_t v = 0; v < even.size(); ++v)
    (even[v] == half.positions[v] ? kept : moved) += triangles[v] > 0;
  CHECK(kept > 100);  // the rim has some 200 vertices
  CHECK(moved > 4000);
}

TEST_CASE("a needle on a folded ball keeps its tip") {
  TriMesh ball = folded_ball();
  const Vec3 at = ball.corner(0, 0), out = at.normalized(), across = out.unitOrthogonal(),
             up = out.cross(across);
  const auto first = static_cast<Index>(ball.positions.size());
  for (const Vec3& corner : {Vec3(0.01 * across), Vec3(0.01 * up), Vec3(-0.01 * across), Vec3(0.2 * out)})
    ball.positions.push_back(at + corner);
  for (const Index c : {0U, 1U, 2U}) ball.triangles.push_back({first + c, first + (c + 1) % 3, first + 3});
  const std::vector<Vec3> even = without_folds({}, ball);
  CHECK((even[first + 3] - ball.positions[first + 3]).norm() < 1e-6);
}
