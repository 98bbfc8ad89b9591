// Noise of scanned surfaces is measured and removed; the truth is known, because it is added here.
#include <doctest/doctest.h>

#include <cmath>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/noise.hpp>
#include <bodice_test/shapes.hpp>

using namespace bodice;
using namespace bodice::geometry;

namespace {

constexpr double kSphereRadius_m = 0.8;

TriMesh with_noise(TriMesh mesh, double sigma_m) {
  const std::vector<Vec3> normals = vertex_normals(mesh);
  engine::Random random(11, 3);
  for (std::size_t v = 0; v < normals.size(); ++v)
    mesh.positions[v] += sigma_m * random.normal() * normals[v];
  return mesh;
}

double mean_off_sphere(const std::vector<Vec3>& positions) {
  double sum = 0.0;
  for (const Vec3& p : positions) sum += std::abs(p.norm() - kSphereRadius_m);
  return sum / static_cast<double>(positions.size());
}

/// A bump of the sphere at +y: 30 mm high, 25 mm from its middle to where it has .6 of that.
double bump(const Vec3& on_sphere) {
  const double beside = (on_sphere - kSphereRadius_m * Vec3::UnitY()).norm();
  return 0.03 * std::exp(-0.5 * beside * beside / (0.025 * 0.025));
}

}  // namespace

TEST_CASE("noise is measured within a twelfth, in any unit, and removed to less than a quarter") {
  for (const double sigma_m : {0.0015, 0.004})
    for (const double unit : {1.0, 1000.0}) {
      CAPTURE(sigma_m);
      TriMesh noisy = with_noise(bodice_test::icosphere(kSphereRadius_m, 6), sigma_m);
      for (Vec3& p : noisy.positions) p *= unit;
      const double noise = noise_of({}, noisy);
      CHECK(noise == doctest::Approx(unit * sigma_m).epsilon(1.0 / 12.0));
      std::vector<Vec3> smooth = without_noise({}, noisy, noise);
      for (Vec3& p : smooth) p /= unit;
      CHECK(mean_off_sphere(smooth) < 0.25 * 0.8 * sigma_m);  // .8: mean of the absolute values
    }
}

TEST_CASE("clean surfaces have no noise: fine, coarse, with edges, with holes, empty") {
  CHECK(noise_of({}, TriMesh{}) == 0.0);
  for (const int level : {1, 2, 3, 5})
    CHECK(noise_of({}, bodice_test::icosphere(kSphereRadius_m, level)) == 0.0);
  TriMesh half = bodice_test::icosphere(kSphereRadius_m, 4);
  std::erase_if(half.triangles, [&](const Triangle& t) { return half.positions[t[0]].x() > 0.0; });
  CHECK(noise_of({}, half) == 0.0);
  TriMesh steps = bodice_test::sheet(1.0, 2.0, 20, 40);
  for (Vec3& p : steps.positions) p.y() = p.x() > 0.2 ? 0.1 : 0.0;
  CHECK(noise_of({}, steps) == 0.0);
}

TEST_CASE("a bump of the surface stays while the noise on it goes") {
  TriMesh clean = bodice_test::icosphere(kSphereRadius_m, 6);
  for (Vec3& p : clean.positions) p *= 1.0 + bump(p) / kSphereRadius_m;
  const TriMesh noisy = with_noise(clean, 0.0015);
  const std::vector<Vec3> smooth = without_noise({}, noisy, 0.0015);
  double off = 0.0, off_noisy = 0.0, count = 0.0;
  for (std::size_t v = 0; v < smooth.size(); ++v) {
    if (bump(clean.positions[v].normalized() * kSphereRadius_m) < 0.003) continue;
    off += (smooth[v] - clean.positions[v]).norm();
    off_noisy += (noisy.positions[v] - clean.positions[v]).norm();
    ++count;
  }
  REQUIRE(count > 40.0);
  CHECK(off < 0.75 * off_noisy);
}

TEST_CASE("a vertex without neighbors, and triangles without area, keep their positions") {
  TriMesh mesh = bodice_test::icosphere(kSphereRadius_m, 2);
  mesh.positions.push_back({2.0, 0.0, 0.0});
  mesh.positions.insert(mesh.positions.end(), 3, Vec3(0.0, 3.0, 0.0));
  const auto last = static_cast<Index>(mesh.positions.size() - 1);
  mesh.triangles.push_back({last - 2, last - 1, last});
  const std::vector<Vec3> smooth = without_noise({}, mesh, 0.01);
  for (Index v = last - 3; v <= last; ++v) CHECK(smooth[v] == mesh.positions[v]);
}

TEST_CASE("quadrics of neighbors leave less than a quarter of noise, of which a vertex' own one leaves .29") {
  const TriMesh clean = bodice_test::icosphere(kSphereRadius_m, 5);
  for (const double sigma_m : {0.0015, 0.004})
    CHECK(mean_off_sphere(without_noise({}, with_noise(clean, sigma_m), sigma_m)) < 0.25 * sigma_m);
}
