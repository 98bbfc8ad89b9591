// The account of penetration is what a user trusts: it is checked on a ball, where the depth is known.

#include <doctest/doctest.h>

#include <limits>

#include <bodice/tryon/penetration.hpp>
#include <bodice/tryon/wardrobe.hpp>
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

TEST_CASE("coarser cloth is kept further off, within bounds") {
  auto square = [](double edge_m) {
    geometry::TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {edge_m, 0, 0}, {0, edge_m, 0}, {edge_m, edge_m, 0}};
    mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
    return mesh;
  };
  CHECK(tryon::covering_thickness_m(square(0.005), 1.7) == doctest::Approx(0.0015).epsilon(0.1));
  CHECK(tryon::covering_thickness_m(square(0.04), 1.7) > 0.003);
  CHECK(tryon::covering_thickness_m(square(0.5), 1.7) == doctest::Approx(0.008));
  CHECK(tryon::covering_thickness_m({}, 1.7) == doctest::Approx(0.0015));
}

TEST_CASE("a tight garment is kept no further off than it was cut") {
  const engine::Context context;
  const geometry::MeshDistance skin(context, bodice_test::icosphere(0.2, 4));
  auto thickness = [&](double gap_m) {
    const geometry::TriMesh coarse =
        bodice_test::icosphere(0.2 + gap_m, 2);  // edges of 6 cm: 8 mm would cover
    return tryon::fitted_thickness_m(context, coarse, skin, 1.7);
  };
  CHECK(thickness(0.05) == doctest::Approx(0.008));
  CHECK(thickness(0.004) == doctest::Approx(0.004).epsilon(0.1));
  CHECK(thickness(0.0) == doctest::Approx(0.0015).epsilon(0.1));
}
