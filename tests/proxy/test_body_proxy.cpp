#include <doctest/doctest.h>

#include <functional>
#include <limits>

#include <bodice_test/extremes.hpp>

#include "sample_proxy.hpp"

using namespace bodice::proxy;
using bodice_test::sample_data;

TEST_CASE("the hash follows every number of the geometry, and not the frame or the source") {
  const auto base = sample_data(1);
  const std::uint64_t hash = BodyProxy::make(base)->hash();
  using Change = std::function<void(BodyProxy::Data&)>;
  const Change changes[] = {[](auto& d) { d.tier = Tier::kTight; },
                            [](auto& d) { d.stature_m += 1e-6; },
                            [](auto& d) { d.margin_m += 1e-6; },
                            [](auto& d) { d.ellipsoids[2].shape.center[1] += 1e-9; },
                            [](auto& d) { d.ellipsoids[0].shape.radii[2] *= 1.0 + 1e-9; },
                            [](auto& d) {
                              d.ellipsoids[3].part =
                                  bodice::body::mirrored(d.ellipsoids[3].part == bodice::body::Part::kHead
                                                             ? bodice::body::Part::kCalfL
                                                             : d.ellipsoids[3].part);
                            },
                            [](auto& d) { d.ellipsoids[4].bone += 1; },
                            [](auto& d) { d.texels[5].h ^= 1; },
                            [](auto& d) { d.texels[5].a ^= 1; },
                            [](auto& d) { d.relief[1].a_offset += 1e-3f; },
                            [](auto& d) { std::swap(d.ellipsoids[0], d.ellipsoids[1]); },
                            [](auto& d) {
                              d.ellipsoids.pop_back();
                              d.relief.pop_back();
                            }};
  for (const Change& change : changes) {
    auto changed = base;
    change(changed);
    const auto proxy = BodyProxy::make(changed);
    REQUIRE(proxy.ok());
    CHECK(proxy->hash() != hash);
  }
  auto moved = base;
  moved.frame.meters_per_unit = 0.01;
  moved.source_hash = 7;
  CHECK(BodyProxy::make(moved)->hash() == hash);
}

TEST_CASE("numbers keep 44 bits and rounding twice changes nothing") {
  const auto data = sample_data(2);
  const auto once = BodyProxy::make(data);
  REQUIRE(once.ok());
  BodyProxy::Data again = data;
  again.ellipsoids.assign(once->ellipsoids().begin(), once->ellipsoids().end());
  CHECK(BodyProxy::make(again)->hash() == once->hash());
  for (std::size_t i = 0; i < data.ellipsoids.size(); ++i)
    CHECK((once->ellipsoids()[i].shape.center - data.ellipsoids[i].shape.center).norm() < 1e-12);
}

TEST_CASE("data that cannot be a proxy are refused, and the ellipsoid is named") {
  using Damage = std::function<void(BodyProxy::Data&)>;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const Damage damages[] = {
      [=](auto& d) { d.ellipsoids[3].shape.center[0] = nan; },
      [=](auto& d) { d.ellipsoids[3].shape.center[2] = inf; },
      [](auto& d) { d.ellipsoids[3].shape.radii[1] = 0.0; },
      [](auto& d) { d.ellipsoids[3].shape.radii[1] = -1.0; },
      [=](auto& d) { d.ellipsoids[3].shape.radii[1] = nan; },
      [](auto& d) { d.ellipsoids[3].shape.axes(0, 0) += 1e-4; },
      [](auto& d) { d.ellipsoids[3].shape.axes.col(0) *= -1.0; },
      [=](auto& d) { d.ellipsoids[3].shape.axes(1, 1) = nan; },
      [](auto& d) { d.ellipsoids[3].part = static_cast<bodice::body::Part>(bodice::body::kAllPartCount); },
      [](auto& d) { d.ellipsoids[3].bone = -2; },
      [](auto& d) { d.relief[3].nodes_per_side = 1; },
      [](auto& d) { d.relief[3].nodes_per_side = 5000; },
      [](auto& d) { d.relief[3] = {8, 0, 0, 0, 0, 0xffffffffu}; },
      [](auto& d) { d.relief[3] = {0, 0, 0, 0, 0, 0xffffffffu}; },
      [=](auto& d) { d.relief[3].h_scale_m = static_cast<float>(nan); }};
  for (const Damage& damage : damages) {
    auto data = sample_data(3);
    damage(data);
    const auto proxy = BodyProxy::make(data);
    REQUIRE_FALSE(proxy.ok());
    CHECK(proxy.error().message.find("ellipsoid 3") != std::string::npos);
  }
  auto uneven = sample_data(3);
  uneven.relief.pop_back();
  CHECK_FALSE(BodyProxy::make(uneven).ok());
  for (double value : {nan, inf, 0.0, -1.0}) {
    auto data = sample_data(3);
    data.frame.meters_per_unit = value;
    CHECK_FALSE(BodyProxy::make(data).ok());
  }
}

TEST_CASE("more texels than a file may hold are refused, and just as many are not") {
  BodyProxy::Data data = sample_data(3, 1, false);
  data.texels.resize(kMaxReliefTexels);
  CHECK(BodyProxy::make(data).ok());
  data.texels.resize(kMaxReliefTexels + 1);
  const auto refused = BodyProxy::make(std::move(data));
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().message.find("relief texels") != std::string::npos);
}

TEST_CASE("proxies of zero, one and 4096 ellipsoids are valid, and so are the extreme shapes") {
  for (int count : {0, 1, 4096}) CHECK(BodyProxy::make(sample_data(4, count)).ok());
  for (const auto& extreme : bodice_test::extreme_ellipsoids()) {
    CAPTURE(extreme.name);
    BodyProxy::Data data;
    data.ellipsoids.push_back({extreme.shape});
    CHECK(BodyProxy::make(data).ok());
  }
}

TEST_CASE("bytes() counts the floats and the tables") {
  CHECK(BodyProxy::make(sample_data(5, 10, false))->bytes() == 600);
}

TEST_CASE("each tier is found by its name") {
  for (Tier tier : {Tier::kPaper, Tier::kSolid, Tier::kTight, Tier::kRelief})
    CHECK(tier_from_name(name(tier)) == tier);
  CHECK_FALSE(tier_from_name("loose").has_value());
}
