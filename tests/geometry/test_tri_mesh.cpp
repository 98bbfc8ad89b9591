#include <doctest/doctest.h>

#include <numbers>

#include <bodice/geometry/mesh_repair.hpp>
#include <bodice_test/shapes.hpp>

using namespace bodice::geometry;
using namespace bodice_test;

TEST_CASE("shapes have the area and volume of the solids they stand for, and face outward") {
  CHECK(signed_volume(box({0.5, 1.0, 2.0}, 3)) == doctest::Approx(8.0));
  CHECK(surface_area(box({0.5, 1.0, 2.0}, 3)) == doctest::Approx(2.0 * (2.0 + 4.0 + 8.0)));
  CHECK(signed_volume(icosphere(2.0, 5)) ==
        doctest::Approx(4.0 / 3.0 * std::numbers::pi * 8.0).epsilon(0.002));
  CHECK(surface_area(icosphere(2.0, 5)) == doctest::Approx(16.0 * std::numbers::pi).epsilon(0.002));
  CHECK(signed_volume(cylinder(0.5, 2.0, 200, 4)) == doctest::Approx(0.5 * std::numbers::pi).epsilon(0.001));
  CHECK(signed_volume(torus(1.0, 0.25, 200, 100)) ==
        doctest::Approx(2.0 * std::numbers::pi * std::numbers::pi * 0.0625).epsilon(0.002));
  CHECK(surface_area(sheet(2.0, 3.0, 5, 4)) == doctest::Approx(6.0));
}

TEST_CASE("volume keeps its digits 10 km from the origin") {
  const double near = signed_volume(icosphere(1e-3, 3));
  const double far = signed_volume(icosphere(1e-3, 3, {6e3, -6.4e3, 4.8e3}));
  CHECK(far == doctest::Approx(near).epsilon(1e-8));
}

TEST_CASE("vertex normals of a sphere are radial at any scale, and zero where nothing gives a direction") {
  for (double scale : {1e-6, 1.0, 1e6}) {
    const TriMesh mesh = icosphere(scale, 3);
    const auto normals = vertex_normals(mesh);
    for (std::size_t v = 0; v < normals.size(); ++v) CHECK(normals[v].dot(mesh.positions[v]) / scale > 0.999);
  }
  TriMesh stray = icosphere(1.0, 1);
  stray.positions.emplace_back(5, 5, 5);
  CHECK(vertex_normals(stray).back() == Vec3::Zero());
}

TEST_CASE("an empty mesh has no area, volume or normals") {
  CHECK(surface_area({}) == 0.0);
  CHECK(signed_volume({}) == 0.0);
  CHECK(vertex_normals({}).empty());
}
