// Exits from points that lie deep between many ellipsoids, beside the shortest that there are.
#include <doctest/doctest.h>

#include "scenes.hpp"

using namespace bodice;
using namespace bodice::collision;
using namespace bodice_test;

namespace {

bool is_outside(const std::vector<Ellipsoid>& shapes, const Vec3& p, double rounding = 0.0) {
  for (const Ellipsoid& e : shapes)
    if ((e.axes.transpose() * (p - e.center)).cwiseQuotient(e.radii).squaredNorm() < 1.0 - rounding)
      return false;
  return true;
}

/// The length of the shortest exit by trying directions, in steps of 3 %.
double shortest_exit_m(const std::vector<Ellipsoid>& shapes, const Vec3& p,
                       const std::vector<Vec3>& directions) {
  for (double length_m = 1e-3;; length_m *= 1.03)
    for (const Vec3& direction : directions)
      if (is_outside(shapes, p + length_m * direction)) return length_m;
}

}  // namespace

TEST_CASE("deep between many ellipsoids, the exit is nearly the shortest" * doctest::test_suite("long")) {
  engine::Random random(5);
  std::vector<Vec3> directions(2000);
  for (Vec3& direction : directions) direction = random_direction(random);
  double most = 0.0, sum = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const auto shapes = random_ellipsoids(seed, 14, 0.08, 0.05, 0.15);
    const Collider collider(proxy_of(shapes));
    for (int i = 0; i < 40; ++i) {
      const Vec3 p = random_vector(random, 0.15);
      if (is_outside(shapes, p)) continue;
      Cloud cloud;
      cloud.add(p - collider.origin());
      collider.resolve({}, cloud.particles(), {});
      const Vec3 x = cloud.position(0) + collider.origin();
      CHECK(is_outside(shapes, x, 1e-5));
      const double longer = (x - p).norm() / shortest_exit_m(shapes, p, directions);
      most = std::max(most, longer);
      sum += longer, ++count;
    }
  }
  REQUIRE(count > 200);
  CHECK(sum / count < 1.02);
  CHECK(most < 1.8);
}
