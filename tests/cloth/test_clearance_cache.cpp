// A cluster that the cache skips touches nothing. The oracle is the distance of each particle in every
// substep.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <limits>

#include <bodice/engine/random.hpp>

#include "contact/clearance_cache.hpp"
#include "fixtures.hpp"

using namespace bodice;
using namespace bodice_test;

namespace {

constexpr double kReach_m = 0.004;
// The last cluster is not full.
constexpr std::size_t kClusters = 40, kCount = kClusters * cloth::kCluster - 13;

std::vector<geometry::Ellipsoid> shapes() {
  std::vector<geometry::Ellipsoid> out;
  for (int k = 0; k < 3; ++k)
    out.push_back(
        {Vec3(0.15 * k, 0.1 * k, 0.0), geometry::Mat3::Identity(), Vec3(0.1, 0.2 - 0.05 * k, 0.07)});
  return out;
}

collision::Collider body_of(const std::vector<geometry::Ellipsoid>& all) {
  proxy::BodyProxy::Data data;
  data.stature_m = 1.0;
  for (const auto& shape : all) data.ellipsoids.push_back({.shape = shape});
  return collision::Collider(*proxy::BodyProxy::make(std::move(data)));
}

double distance_m(const std::vector<geometry::Ellipsoid>& all, const Vec3& at) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& shape : all) least = std::min(least, geometry::closest_point(shape, at).signed_distance);
  return least;
}

Vec3 random_point(const engine::Random& random, std::uint64_t key, double reach) {
  return reach * Vec3(2.0 * random.uniform_at(3 * key) - 1.0, 2.0 * random.uniform_at(3 * key + 1) - 1.0,
                      2.0 * random.uniform_at(3 * key + 2) - 1.0);
}

/// Clusters of 4 cm at random points up to half a meter away, some of them in the body.
cloth::Particles scatter(const engine::Random& random, const Vec3& origin) {
  cloth::Particles p;
  p.size = kCount;
  p.origin = origin;
  for (auto* a : {&p.x, &p.y, &p.z, &p.old_x, &p.old_y, &p.old_z}) a->assign(kCount + 3, 0.0f);
  for (std::size_t i = 0; i < kCount; ++i) {
    const Vec3 at = random_point(random, i / cloth::kCluster, 0.5) + random_point(random, 1000 + i, 0.02);
    p.x[i] = static_cast<float>(at[0]), p.y[i] = static_cast<float>(at[1]),
    p.z[i] = static_cast<float>(at[2]);
  }
  return p;
}

const std::vector<std::uint8_t> untouched(kCount, 0);

cloth::ContactFrame frame_of(const collision::Collider* body, double travel_m) {
  return {.body = body, .thickness_m = kReach_m, .travel_m = travel_m};
}

/// Moves each cluster in its own direction, and one random particle of each twice as far.
void travel(const engine::Random& random, std::uint64_t substep, cloth::Particles& p) {
  p.old_x = p.x, p.old_y = p.y, p.old_z = p.z;
  for (std::size_t i = 0; i < kCount; ++i) {
    const std::uint64_t cluster = i / cloth::kCluster;
    const bool fast = i % cloth::kCluster == random.bits_at(77 * cluster + substep) % cloth::kCluster;
    const Vec3 by = (fast ? 2.0 : 1.0) * random_point(random, 5000 + cluster + substep / 4 * 100, 0.015);
    p.x[i] += static_cast<float>(by[0]), p.y[i] += static_cast<float>(by[1]),
        p.z[i] += static_cast<float>(by[2]);
  }
}

}  // namespace

TEST_CASE(
    "clearance cache: the cluster of a touching particle is never skipped, and not in the rest of the "
    "frame") {
  const std::vector<geometry::Ellipsoid> all = shapes();
  const collision::Collider body = body_of(all);
  std::size_t clear = 0, in_reach = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const engine::Random random(seed);
    cloth::Particles p = scatter(random, body.origin());
    cloth::ClearanceCache clearance = cloth::make_clearance_cache(kCount);
    // The result holds for any expected travel: some particles travel farther than all but the last of these.
    const double expected_m = std::array{0.0, 0.01, 0.05, 0.2, 1.0}[seed - 1];
    cloth::begin_clearance_frame({}, frame_of(&body, expected_m), untouched, p, clearance);
    std::vector<bool> may(kClusters, false);
    for (std::uint64_t substep = 0; substep < 16; ++substep) {
      travel(random, substep, p);
      for (std::size_t c = 0; c < kClusters; ++c) {
        const std::size_t begin = c * cloth::kCluster, end = std::min(begin + cloth::kCluster, kCount);
        const bool now = cloth::may_touch(p, begin, end, clearance);
        CHECK((now || !may[c]));
        may[c] = now;
        clear += !now;
        for (std::size_t i = begin; i < end; ++i) {
          const bool reached = distance_m(all, p.world(i)) < kReach_m;
          in_reach += reached;
          if (reached) REQUIRE(now);
        }
      }
    }
  }
  CHECK(clear > 200);      // some clusters are clear,
  CHECK(in_reach > 1000);  // and enough particles touch to be missed
}

TEST_CASE("clearance cache: without a body every cluster may touch") {
  const collision::Collider body = body_of(shapes());
  cloth::Particles p = scatter(engine::Random(3), body.origin() + Vec3::Constant(9.0));
  cloth::ClearanceCache clearance = cloth::make_clearance_cache(kCount);
  cloth::begin_clearance_frame({}, frame_of(nullptr, 1.0), {}, p, clearance);
  for (std::size_t c = 0; c + 1 < kClusters; ++c)
    CHECK(cloth::may_touch(p, c * cloth::kCluster, (c + 1) * cloth::kCluster, clearance));
}

TEST_CASE("clearance cache: one touching particle makes its own cluster touch, and no other cluster") {
  const collision::Collider body = body_of(shapes());
  cloth::Particles p = scatter(engine::Random(3), body.origin());
  for (float& y : p.y) y += 9.0f;
  p.old_x = p.x, p.old_y = p.y, p.old_z = p.z;
  std::vector<std::uint8_t> touching = untouched;
  touching[2 * cloth::kCluster - 1] = 1;
  cloth::ClearanceCache clearance = cloth::make_clearance_cache(kCount);
  cloth::begin_clearance_frame({}, frame_of(&body, 1.0), touching, p, clearance);
  for (std::size_t c = 0; c + 1 < kClusters; ++c)
    CHECK(cloth::may_touch(p, c * cloth::kCluster, (c + 1) * cloth::kCluster, clearance) == (c == 1));
}

TEST_CASE("clearance cache: the cluster of a touching particle is not skipped where relief is steep") {
  // The ball has rings half a millimeter apart, alternately flat and 2.5 mm high.
  constexpr double kRadius_m = 0.05;
  constexpr int kNodes = 255;
  proxy::BodyProxy::Data data;
  data.tier = proxy::Tier::kRelief;
  data.stature_m = 1.7;
  data.ellipsoids.resize(1);
  data.ellipsoids[0].shape.radii.setConstant(kRadius_m);
  data.relief.resize(1);
  data.relief[0].nodes_per_side = kNodes;
  data.relief[0].h_scale_m = 0.0025f;
  for (int j = 0; j < kNodes; ++j)
    for (int i = 0; i < kNodes; ++i) {
      // The whole border has the same value.
      const int ring = std::min({i, j, kNodes - 1 - i, kNodes - 1 - j});
      data.texels.push_back({static_cast<std::uint8_t>(ring / 2 % 2 == 0 ? 0 : 255), 0});
    }
  const auto proxy = proxy::BodyProxy::make(std::move(data));
  REQUIRE(proxy.ok());
  const collision::Collider body(*proxy);
  std::size_t clear = 0, in_reach = 0, missed = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const engine::Random random(seed);
    cloth::Particles p = scatter(random, body.origin());
    for (std::size_t i = 0; i < kCount;
         ++i) {  // a cluster is at one point, up to 6 mm beyond touching the ball
      const std::uint64_t cluster = i / cloth::kCluster;
      const double height_m = kRadius_m + kReach_m + 0.006 * random.uniform_at(40000 + cluster);
      const Vec3 at = height_m * random_point(random, 9000 + cluster, 1.0).normalized() +
                      random_point(random, 50000 + i, 1e-4);
      p.x[i] = static_cast<float>(at[0]), p.y[i] = static_cast<float>(at[1]),
      p.z[i] = static_cast<float>(at[2]);
    }
    cloth::ClearanceCache clearance = cloth::make_clearance_cache(kCount);
    cloth::begin_clearance_frame({}, frame_of(&body, 0.01), untouched, p, clearance);
    p.old_x = p.x, p.old_y = p.y, p.old_z = p.z;
    for (std::size_t i = 0; i < kCount; ++i) {
      const Vec3 by = random_point(random, 100000 + i / cloth::kCluster, 5e-4);
      p.x[i] += static_cast<float>(by[0]), p.y[i] += static_cast<float>(by[1]),
          p.z[i] += static_cast<float>(by[2]);
    }
    for (std::size_t c = 0; c < kClusters; ++c) {
      const std::size_t begin = c * cloth::kCluster, end = std::min(begin + cloth::kCluster, kCount);
      bool reached = false;
      for (std::size_t i = begin; i < end; ++i)
        reached |= double{body.query({p.x[i], p.y[i], p.z[i]}).signed_distance} < kReach_m;
      const bool may = cloth::may_touch(p, begin, end, clearance);
      clear += !may;
      in_reach += reached;
      missed += reached && !may;
    }
  }
  CHECK(clear > 100);
  CHECK(in_reach > 100);
  CHECK(missed == 0);
}
