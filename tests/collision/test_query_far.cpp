#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include <bodice/proxy/proxy_distance.hpp>

#include "scenes.hpp"

using namespace bodice;
using namespace bodice::collision;
using namespace bodice_test;

TEST_CASE("distances ten kilometers from the origin are those at the origin to 2 micrometers") {
  auto shapes = random_ellipsoids(3, 40, 0.6, 0.03, 0.2);
  const Collider near(proxy_of(shapes));
  const Vec3 away(10'000.0, 0.0, -10'000.0);
  for (Ellipsoid& e : shapes) e.center += away;
  const Collider far(proxy_of(shapes));
  engine::Random random(1);
  double worst_m = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p = random_vector(random, 1.0);
    const Vec3 a = p - near.origin(), b = p + away - far.origin();
    const Contact at_origin = near.query({float(a.x()), float(a.y()), float(a.z())});
    const Contact at_distance = far.query({float(b.x()), float(b.y()), float(b.z())});
    worst_m =
        std::max(worst_m, std::abs(double{at_origin.signed_distance} - double{at_distance.signed_distance}));
  }
  CHECK(worst_m < 2e-6);
}

TEST_CASE("a particle far away does not change the results of its neighbors in the block" *
          doctest::test_suite("long")) {
  constexpr int kBlockParticles = 64;
  const proxy::BodyProxy proxy = proxy_of(random_ellipsoids(13, 120, 0.6, 0.03, 0.2));
  const Collider collider(proxy);
  engine::Random random(29);
  double worst_m = 0.0, lowest_m = 1.0;
  for (int block = 0; block < 200; ++block) {
    Cloud cloud;
    cloud.add(std::pow(10.0, random.uniform(2.0, 8.0)) * random_direction(random));
    while (cloud.size() < kBlockParticles) cloud.add(random_vector(random, 0.7));
    const Cloud before = cloud;
    std::vector<Contact> contacts(cloud.size());
    collider.query({}, cloud.particles(), contacts);
    Cloud filleted = before;
    collider.resolve({}, cloud.particles(), {});
    collider.resolve({}, filleted.particles(), {.blend_m = 0.01f});
    for (std::size_t i = 1; i < kBlockParticles; ++i) {
      const double truth = proxy::proxy_distance(proxy, before.position(i) + collider.origin()).distance;
      worst_m = std::max(worst_m, std::abs(truth - double{contacts[i].signed_distance}));
      for (const Cloud* out : {&cloud, &filleted})
        lowest_m =
            std::min(lowest_m, proxy::proxy_distance(proxy, out->position(i) + collider.origin()).distance);
    }
  }
  CHECK(worst_m < 2e-6);
  CHECK(lowest_m > -2e-6);
}
