#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>

#include <bodice/engine/hash.hpp>
#include <bodice_test/allocations.hpp>
#include <bodice_test/executors.hpp>

#include <bodice_test/targets.hpp>
#include "scenes.hpp"

using namespace bodice;
using namespace bodice::collision;
using namespace bodice_test;

namespace {

constexpr int kParticles = 30000;

proxy::BodyProxy scene(bool relief) {
  const auto data = data_of(random_ellipsoids(31, 89, 0.6, 0.04, 0.2));
  return proxy_of(relief ? with_relief(data, 16, 0.002, 3) : data);
}

Cloud random_cloud() {
  engine::Random random(77);
  Cloud cloud;
  for (int i = 0; i < kParticles; ++i) cloud.add(random_vector(random, 0.8), random_vector(random, 1.0));
  return cloud;
}

std::uint64_t hash_of(const Cloud& cloud) {
  engine::Hasher hasher;
  for (const auto* values : {&cloud.x, &cloud.y, &cloud.z, &cloud.vx, &cloud.vy, &cloud.vz})
    hasher.add(std::span<const float>(*values));
  return hasher.value();
}

}  // namespace

TEST_CASE("a response gives the same bits for any number of workers, with and without a workspace" *
          doctest::test_suite("long")) {
  for (const bool relief : {false, true}) {
    const Collider collider(scene(relief));
    const auto run = [&](engine::Executor& executor, bool with_workspace) {
      engine::Context context{.executor = &executor};
      Cloud cloud = random_cloud();
      Workspace workspace;
      for (int call = 0; call < 3; ++call) {
        if (with_workspace)
          collider.resolve(context, cloud.particles(), {.thickness_m = 0.002f}, workspace);
        else
          collider.resolve(context, cloud.particles(), {.thickness_m = 0.002f});
        for (float& y : cloud.y) y -= 0.002f;
      }
      return hash_of(cloud);
    };
    for (const bool with_workspace : {false, true}) {
      const std::uint64_t serial = run(engine::inline_executor(), with_workspace);
      for (const int workers : {1, 2, 5})
        CHECK(run(*bodice_test::make_threads(workers), with_workspace) == serial);
    }
  }
}

TEST_CASE("a query's results do not depend on which particles share a block") {
  for (const bool relief : {false, true}) {
    const Collider collider(scene(relief));
    Cloud cloud = random_cloud();
    std::vector<Contact> together(cloud.size()), ordered(cloud.size());
    collider.query({}, cloud.particles(), together);
    Workspace workspace;
    collider.query({}, cloud.particles(), ordered, workspace);
    int differ = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Contact alone = i % 50 == 0 ? collider.query({cloud.x[i], cloud.y[i], cloud.z[i]}) : together[i];
      differ += std::memcmp(&together[i], &ordered[i], sizeof(Contact)) != 0;
      differ += std::memcmp(&together[i], &alone, sizeof(Contact)) != 0;
    }
    CHECK(differ == 0);
  }
}

TEST_CASE("all instruction sets agree on distances to 2 micrometers, with relief to 10") {
  for (const bool relief : {false, true}) {
    const Collider collider(scene(relief));
    Cloud cloud = random_cloud();
    std::vector<Contact> best(cloud.size()), other(cloud.size());
    collider.query({}, cloud.particles(), best);
    int targets = 0;
    on_every_target([&](const std::string& name) {
      CAPTURE(name);
      ++targets;
      collider.query({}, cloud.particles(), other);
      double worst_m = 0.0;
      for (std::size_t i = 0; i < cloud.size(); ++i)
        worst_m =
            std::max(worst_m, std::abs(double{best[i].signed_distance} - double{other[i].signed_distance}));
      CHECK(worst_m < (relief ? 1e-5 : 2e-6));
    });
    CHECK(targets >= 1);
  }
}

TEST_CASE("a response resolves every particle on every instruction set" * doctest::test_suite("long")) {
  for (const bool relief : {false, true}) {
    const Collider collider(scene(relief));
    on_every_target([&](const std::string& name) {
      CAPTURE(name);
      Cloud cloud = random_cloud();
      CHECK(collider.resolve({}, cloud.particles(), {}).unresolved == 0);
      const ContactReport again = collider.resolve({}, cloud.particles(), {});
      CHECK(again.deepest_m < 1e-6f);
    });
  }
}

TEST_CASE("a query of many particles in scattered order gives the bits of single queries" *
          doctest::test_suite("long")) {
  for (const bool relief : {false, true}) {
    const Collider collider(scene(relief));
    Cloud cloud = random_cloud();
    cloud.x[17] = std::numeric_limits<float>::quiet_NaN();
    std::vector<Contact> together(cloud.size());
    for (const int workers : {1, 3}) {
      const auto executor = bodice_test::make_threads(workers);
      std::fill(together.begin(), together.end(), Contact{});
      collider.query(engine::Context{.executor = executor.get()}, cloud.particles(), together);
      int differ = 0;
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        const Contact alone = collider.query({cloud.x[i], cloud.y[i], cloud.z[i]});
        differ += std::memcmp(&together[i], &alone, sizeof(Contact)) != 0;
      }
      CHECK(differ == 0);
    }
  }
}

TEST_CASE("warm queries and responses allocate nothing; queries of scattered ones need a workspace for that" *
          doctest::test_suite("long")) {
  if (!counts_allocations()) return;
  for (const bool relief : {false, true}) {
    const Collider collider(scene(relief));
    Cloud cloud = random_cloud();
    std::sort(cloud.x.begin(), cloud.x.end());
    std::fill(cloud.y.begin(), cloud.y.end(), 0.1f);
    std::vector<Contact> contacts(cloud.size());
    Workspace workspace;
    const auto frame = [&] {
      for (float& y : cloud.y) y -= 0.001f;
      collider.query({}, cloud.particles(), contacts);
      collider.query({}, cloud.particles(), contacts, workspace);
      collider.query({}, cloud.particles(), contacts, {.accuracy = Accuracy::kFirstOrder});
      collider.query({}, cloud.particles(), contacts, workspace, {.accuracy = Accuracy::kFirstOrder});
      collider.resolve({}, cloud.particles(), {}, workspace);
      collider.resolve({}, cloud.particles(), {});
    };
    frame();
    const std::size_t before = allocations();
    for (int i = 0; i < 3; ++i) frame();
    CHECK(allocations() == before);
  }
}

TEST_CASE("a move to the current pose changes no position and allocates nothing") {
  const auto proxy = scene(false);
  Collider moved(proxy), still(proxy);
  std::vector<Ellipsoid> shapes;
  for (const auto& e : proxy.ellipsoids()) shapes.push_back(e.shape);
  const std::size_t before = allocations();
  moved.move_to(shapes, 0.01);
  if (counts_allocations()) CHECK(allocations() == before);
  Cloud a = random_cloud(), b = a;
  moved.resolve({}, a.particles(), {});
  still.resolve({}, b.particles(), {});
  CHECK(a.x == b.x);
  CHECK(a.y == b.y);
  // The body's velocity is the rounding of two equal poses, not exactly zero.
  double worst_m_s = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    worst_m_s = std::max(worst_m_s, (a.velocity(i) - b.velocity(i)).norm());
  CHECK(worst_m_s < 1e-5);
}
