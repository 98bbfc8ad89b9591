// The account of penetration is what a user trusts: it is checked on a ball, where the depth is known.

#include <doctest/doctest.h>

#include <limits>

#include <bodice/tryon/penetration.hpp>
#include <bodice_test/shapes.hpp>

using namespace bodice;
using geometry::Vec3;

TEST_CASE("particles inside a ball are counted at their depth") {
  const geometry::TriMesh ball = bodice_test::icosphere(1.0, 5);
  const engine::Context context;
  const geometry::MeshDistance skin(context, ball);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec3> positions = {{0.99, 0, 0}, {0, 0.9995, 0}, {0, 0, 1.5},
                                       {0.5, 0, 0},  {nan, 0, 0},    {0, 3, 4}};
  const tryon::Penetration found = tryon::penetration(context, skin, positions);
  CHECK(found.over_1mm == 2);
  CHECK(found.deepest_m == doctest::Approx(0.5).epsilon(0.01));
}

TEST_CASE("a sheet through a ball is pierced although its corners are outside") {
  const engine::Context context;
  const geometry::MeshDistance skin(context, bodice_test::icosphere(1.0, 4));
  const std::vector<Vec3> corners = {{-3, 0, -3}, {3, 0, -3}, {0, 0, 6}, {-3, 9, -3}, {3, 9, -3}, {0, 9, 6}};
  const std::vector<geometry::Triangle> triangles = {{0, 1, 2}, {3, 4, 5}};
  CHECK(tryon::penetration(context, skin, corners).over_1mm == 0);
  CHECK(tryon::pierced_share(context, skin, corners, triangles) == doctest::Approx(0.5));
}
