// A contact distance selects which particles get a result, and changes no bit of a result.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <tuple>

#include <bodice_test/executors.hpp>
#include <bodice_test/targets.hpp>
#include "scenes.hpp"

using namespace bodice;
using namespace bodice::collision;
using namespace bodice_test;

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kLimits_m[] = {-0.05f, -0.01f, 0.0f, 1e-4f, 0.01f, 0.03f, 0.2f, 1e4f, 3e38f, -kInf, kNaN};

proxy::BodyProxy scene(bool relief, double margin_m) {
  auto data = data_of(random_ellipsoids(31, 89, 0.6, 0.04, 0.2));
  data.margin_m = margin_m;
  return proxy_of(relief ? with_relief(data, 16, 0.004, 3) : data);
}

/// Particles near the surface and far from it; some are not finite.
Cloud random_cloud(int count) {
  engine::Random random(77);
  Cloud cloud;
  for (int i = 0; i < count; ++i) cloud.add(random_vector(random, i % 40 == 0 ? 30.0 : 0.8));
  for (int i = 17; i < count; i += 501) cloud.y[static_cast<std::size_t>(i)] = i % 2 == 0 ? kNaN : kInf;
  for (int i = 29; i < count; i += 997) cloud.x[static_cast<std::size_t>(i)] = 1e20f;
  return cloud;
}

/// The same particles sorted by cells, so that neighbors are consecutive.
Cloud in_order(const Cloud& cloud) {
  std::vector<std::size_t> order(cloud.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto cell = [](float v) {
    return std::isfinite(v) ? std::floor(std::clamp(v, -1.0f, 1.0f) / 0.1f) : 99.0f;
  };
  const auto key = [&](std::size_t i) {
    return std::tuple(cell(cloud.x[i]), cell(cloud.y[i]), cell(cloud.z[i]), i);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  Cloud result;
  for (const std::size_t i : order) result.add(cloud.position(i));
  return result;
}

bool same_bits(const Contact& a, const Contact& b) {
  return std::memcmp(&a, &b, sizeof(Contact)) == 0;
}

/// The definition: an unlimited result, replaced by none beyond the contact distance.
Contact filtered(const Contact& unlimited, float within_m) {
  if (unlimited.signed_distance <= within_m) return unlimited;
  Contact none;
  none.signed_distance = kInf;
  none.ellipsoid = kNoEllipsoid;
  return none;
}

int differing(const std::vector<Contact>& limited, const std::vector<Contact>& unlimited, float within_m) {
  int result = 0;
  for (std::size_t i = 0; i < limited.size(); ++i)
    result += !same_bits(limited[i], filtered(unlimited[i], within_m));
  return result;
}

}  // namespace

TEST_CASE("a query with a contact distance gives the bits of an unlimited query, filtered" *
          doctest::test_suite("long")) {
  for (const bool relief : {false, true})
    for (const double margin_m : {0.0, 0.003}) {
      const Collider collider(scene(relief, margin_m));
      const Cloud scattered = random_cloud(20011);
      for (Cloud cloud : {scattered, in_order(scattered)}) {
        std::vector<Contact> unlimited(cloud.size()), limited(cloud.size());
        collider.query({}, cloud.particles(), unlimited);
        Workspace workspace;
        for (const float within_m : kLimits_m) {
          CAPTURE(relief);
          CAPTURE(within_m);
          collider.query({}, cloud.particles(), limited, {.within_m = within_m});
          CHECK(differing(limited, unlimited, within_m) == 0);
          collider.query({}, cloud.particles(), limited, workspace, {.within_m = within_m});
          CHECK(differing(limited, unlimited, within_m) == 0);
        }
      }
    }
}

TEST_CASE("a contact distance filters exactly where the octants of an ellipsoid differ in height" *
          doctest::test_suite("long")) {
  // The ellipsoids are larger than the gaps between them, so that many particles have a single candidate.
  const auto data = data_of(random_ellipsoids(8, 24, 0.7, 0.06, 0.12));
  for (const int nodes : {2, 5, 16}) {
    const Collider collider(proxy_of(with_lopsided_relief(data, nodes, 0.02)));
    Cloud cloud = in_order(random_cloud(20011));
    std::vector<Contact> unlimited(cloud.size()), limited(cloud.size());
    on_every_target([&](const std::string& name) {
      CAPTURE(name);
      CAPTURE(nodes);
      collider.query({}, cloud.particles(), unlimited);
      for (const float within_m : {-0.01f, 0.0f, 0.01f}) {
        collider.query({}, cloud.particles(), limited, {.within_m = within_m});
        CHECK(differing(limited, unlimited, within_m) == 0);
      }
    });
  }
}

TEST_CASE(
    "a contact distance gives the same bits for one particle as for many, and for any number of workers") {
  for (const bool relief : {false, true}) {
    const Collider collider(scene(relief, 0.001));
    Cloud cloud = random_cloud(6000);
    std::vector<Contact> together(cloud.size()), shared(cloud.size());
    for (const float within_m : {0.0f, 0.01f}) {
      collider.query({}, cloud.particles(), together, {.within_m = within_m});
      int differ = 0;
      for (std::size_t i = 0; i < cloud.size(); i += 7)
        differ += !same_bits(together[i],
                             collider.query({cloud.x[i], cloud.y[i], cloud.z[i]}, {.within_m = within_m}));
      CHECK(differ == 0);
      const auto executor = bodice_test::make_threads(3);
      collider.query({.executor = executor.get()}, cloud.particles(), shared, {.within_m = within_m});
      CHECK(std::memcmp(together.data(), shared.data(), together.size() * sizeof(Contact)) == 0);
    }
  }
}

TEST_CASE("a contact distance filters exactly on every instruction set" * doctest::test_suite("long")) {
  for (const bool relief : {false, true}) {
    const Collider collider(scene(relief, 0.0));
    Cloud cloud = random_cloud(5000);
    std::vector<Contact> unlimited(cloud.size()), limited(cloud.size());
    on_every_target([&](const std::string& name) {
      CAPTURE(name);
      collider.query({}, cloud.particles(), unlimited);
      for (const float within_m : {-0.01f, 0.0f, 0.02f}) {
        collider.query({}, cloud.particles(), limited, {.within_m = within_m});
        CHECK(differing(limited, unlimited, within_m) == 0);
      }
    });
  }
}

TEST_CASE("a contact distance filters plain results exactly, and relief to 2 micrometers, on overflow") {
  for (const bool relief : {false, true}) {
    const auto data = data_of(random_ellipsoids(5, 700, 0.05, 0.08, 0.1));
    const Collider collider(proxy_of(relief ? with_relief(data, 4, 0.002, 3) : data));
    engine::Random random(3);
    Cloud cloud;
    for (int i = 0; i < 1500; ++i) cloud.add(random_vector(random, 0.2));
    std::vector<Contact> unlimited(cloud.size()), limited(cloud.size());
    collider.query({}, cloud.particles(), unlimited);
    for (const float within_m : {-0.05f, 0.0f, 0.05f}) {
      collider.query({}, cloud.particles(), limited, {.within_m = within_m});
      CAPTURE(relief);
      CAPTURE(within_m);
      if (!relief) CHECK(differing(limited, unlimited, within_m) == 0);
      // Where so many ellipsoids blend, the limit may decide which of the two precisions evaluates a
      // particle.
      double worst_m = 0.0;
      int wrong = 0;
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        const float truth = unlimited[i].signed_distance, found = limited[i].signed_distance;
        wrong += std::isfinite(found) != (truth <= within_m) && std::abs(truth - within_m) > 2e-6f;
        if (std::isfinite(found)) worst_m = std::max(worst_m, double{std::abs(found - truth)});
      }
      CHECK(wrong == 0);
      CHECK(worst_m < 2e-6);
    }
  }
}
