#include <doctest/doctest.h>

#include <vector>

#include <bodice/geometry/sampling.hpp>
#include <bodice_test/extremes.hpp>
#include <bodice_test/shapes.hpp>

using namespace bodice::geometry;
using namespace bodice_test;

TEST_CASE("samples lie on their triangles, sum to the area and spread by area") {
  TriMesh mesh = box({1.0, 0.1, 0.5}, 3);
  const std::size_t count = 5000;
  const auto samples = sample_surface(mesh, count, 3);
  REQUIRE(samples.size() == count);
  std::vector<double> hits(mesh.triangles.size(), 0.0);
  double area = 0.0;
  for (const SurfaceSample& s : samples) {
    const Vec3 n = area_vector(mesh, s.triangle).normalized();
    CHECK(std::abs(n.dot(s.point - mesh.corner(s.triangle, 0))) < 1e-14);
    for (int k = 0; k < 3; ++k) {
      const Vec3 edge = mesh.corner(s.triangle, (k + 1) % 3) - mesh.corner(s.triangle, k);
      CHECK(edge.cross(s.point - mesh.corner(s.triangle, k)).dot(n) >= -1e-14);
    }
    hits[s.triangle] += s.area;
    area += s.area;
  }
  CHECK(area == doctest::Approx(surface_area(mesh)));
  // Samples are stratified: each triangle gets its area, up to the two strata at its ends.
  for (std::size_t t = 0; t < hits.size(); ++t)
    CHECK(std::abs(hits[t] - 0.5 * area_vector(mesh, t).norm()) <= 2.0 * area / count);
}

TEST_CASE("the mean over samples converges faster than random ones would") {
  // The mean of x^2 over the unit sphere is 1/3; 4096 random points err by about .0047.
  const TriMesh mesh = icosphere(1.0, 5);
  const auto samples = sample_surface(mesh, 4096, 1);
  double sum = 0.0;
  for (const SurfaceSample& s : samples) sum += s.point[0] * s.point[0] / s.point.squaredNorm();
  CHECK(std::abs(sum / 4096.0 - 1.0 / 3.0) < 0.001);
}

TEST_CASE("the same arguments give the same samples; another seed gives others") {
  const TriMesh mesh = torus(1.0, 0.3, 16, 8);
  const auto a = sample_surface(mesh, 100, 5);
  const auto b = sample_surface(mesh, 100, 5);
  const auto c = sample_surface(mesh, 100, 6);
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(a[i].point == b[i].point);
  CHECK(a[0].point != c[0].point);
}

TEST_CASE("meshes without area give no samples; hostile ones give finite samples") {
  CHECK(sample_surface({}, 10, 1).empty());
  CHECK(sample_surface(icosphere(1.0, 1), 0, 1).empty());
  CHECK(sample_surface({{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}, {{0, 1, 2}}}, 10, 1).empty());
  for (const MeshCase& extreme : extreme_meshes()) {
    if (extreme.name.find("range") != std::string::npos) continue;
    CAPTURE(extreme.name);
    for (const SurfaceSample& s : sample_surface(extreme.mesh, 500, 1)) CHECK(s.point.allFinite());
  }
}
