// Exercises, in which binding bends the limbs: the buried texels that have to yield more are found there.
#include <algorithm>

#include <doctest/doctest.h>

#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/sampling.hpp>

#include "moving_body.hpp"

using namespace bodice;
using namespace binding_test;
using geometry::Vec3;

namespace {

proxy::BodyProxy bound_to(const MovingBody& moving, std::span<const body::Part> part) {
  proxy::BodyProxy::Data data = moving.bound.data();
  data.binding = nullptr;
  const auto rest = proxy::BodyProxy::make(std::move(data));
  REQUIRE(rest);
  auto bound = binding::bind({}, *rest, {moving.body.mesh, moving.body.skeleton, moving.body.weights, part});
  REQUIRE(bound);
  return std::move(bound).value();
}

/// The largest and the summed length by which the proxy has points too deep, on the skin and over it.
struct TooDeep {
  double most_m = 0.0, sum_m = 0.0;
};

TooDeep too_deep(const proxy::BodyProxy& bound, const MovingBody& moving, const Pose& pose) {
  auto poser = binding::Poser::make(bound);
  REQUIRE(poser);
  REQUIRE(poser->pose({}, pose));
  const geometry::TriMesh skin = posed_skin(moving, pose);
  const geometry::MeshDistance distance({}, skin);
  TooDeep found;
  for (const auto& sample : geometry::sample_surface(skin, 6000, 17)) {
    const Vec3 normal = geometry::area_vector(skin, sample.triangle).stableNormalized();
    for (const double over_m : {0.002, 0.01, 0.02}) {
      const Vec3 point = sample.point + over_m * normal;
      const double truth_m = distance.signed_distance(point);
      if (truth_m < 0.5 * over_m) continue;  // under another layer
      const double off_m = truth_m - proxy::posed_proxy_distance(bound, poser->posed(), point).distance;
      found.most_m = std::max(found.most_m, off_m);
      found.sum_m += std::max(0.0, off_m - 0.003);
    }
  }
  return found;
}

}  // namespace

TEST_CASE("in a squat the proxy is less than half as much over the skin as without exercises") {
  const MovingBody& moving = moving_body();
  const Vec3 left = Vec3::UnitX();
  const Pose squat = turned(moving.body.skeleton, {{"thigh_l", {left, -100.0}},
                                                   {"thigh_r", {left, -100.0}},
                                                   {"calf_l", {left, 110.0}},
                                                   {"calf_r", {left, 110.0}}});
  const TooDeep without = too_deep(bound_to(moving, {}), moving, squat);
  const TooDeep with = too_deep(bound_to(moving, moving.body.part), moving, squat);
  MESSAGE("worst point " << 1e3 * without.most_m << " mm without, " << 1e3 * with.most_m << " mm with");
  CHECK(with.sum_m < 0.5 * without.sum_m);
  CHECK(with.most_m < 0.7 * without.most_m);
}

TEST_CASE("exercises only raise burial, and only of texels that were buried at rest") {
  const MovingBody& moving = moving_body();
  const proxy::BodyProxy without = bound_to(moving, {}), with = bound_to(moving, moving.body.part);
  const auto &before = without.binding()->burial, &after = with.binding()->burial;
  REQUIRE(before.size() == after.size());
  CHECK(without.binding()->burial_step_m == with.binding()->burial_step_m);
  std::size_t raised = 0;
  bool never_less = true, none_new = true;
  for (std::size_t i = 0; i < before.size(); ++i) {
    raised += after[i] > before[i];
    never_less = never_less && after[i] >= before[i];
    none_new = none_new && (before[i] > 0 || after[i] == 0);
  }
  CHECK(never_less);
  CHECK(none_new);
  CHECK(raised > before.size() / 1000);
}
