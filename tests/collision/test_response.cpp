#include <doctest/doctest.h>

#include "scenes.hpp"

using namespace bodice;
using namespace bodice::collision;
using namespace bodice_test;

namespace {

Cloud around_origin(std::uint64_t seed, int count, double half_side) {
  engine::Random random(seed);
  Cloud cloud;
  for (int i = 0; i < count; ++i) cloud.add(random_vector(random, half_side), random_vector(random, 1.0));
  return cloud;
}

}  // namespace

TEST_CASE("after the nearest response no particle is inside, whatever the union looks like") {
  struct Scene {
    int ellipsoids;
    double least_m, largest_m;
  };
  for (const Scene scene :
       {Scene{1, 0.05, 0.3}, {2, 0.1, 0.3}, {12, 0.05, 0.3}, {80, 0.02, 0.4}, {8, 0.001, 1.0}}) {
    const auto shapes = random_ellipsoids(7, scene.ellipsoids, 0.4, scene.least_m, scene.largest_m);
    const Collider collider(proxy_of(shapes));
    for (const float thickness_m : {0.0f, 0.004f}) {
      Cloud cloud = around_origin(11, 20000, 0.8);
      const ContactReport report = collider.resolve({}, cloud.particles(), {.thickness_m = thickness_m});
      CHECK(report.contacts > 100);
      CHECK(report.unresolved == 0);
      double lowest_m = 1.0;
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        const double d = brute_force(shapes, cloud.position(i) + collider.origin()).signed_distance;
        lowest_m = std::min(lowest_m, d - double{thickness_m});
      }
      CAPTURE(scene.ellipsoids);
      CAPTURE(thickness_m);
      CHECK(lowest_m > -1e-6);
    }
  }
}
