#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include <bodice/engine/random.hpp>
#include <bodice/proxy/add_things.hpp>
#include <bodice/proxy/posed_proxy.hpp>
#include <bodice/proxy/proxy_distance.hpp>
#include <bodice/proxy/proxy_file.hpp>

#include "sample_proxy.hpp"

using namespace bodice::proxy;
using bodice::geometry::Vec3;
using bodice_test::made;
using bodice_test::sample_data;

namespace {

/// Sample data of the stature and margin of another, moved by `x` along the first axis.
BodyProxy::Data beside(const BodyProxy::Data& body, std::uint64_t seed, double x, bool relief) {
  BodyProxy::Data data = sample_data(seed, 7, relief);
  data.stature_m = body.stature_m;
  data.margin_m = body.margin_m;
  for (ProxyEllipsoid& e : data.ellipsoids) {
    e.shape.center.x() += x;
    e.part = bodice::body::thing_part(2);
  }
  return data;
}

BodyProxy joined(const BodyProxy& body, std::span<const BodyProxy> things) {
  auto all = add_things(body, things);
  REQUIRE_MESSAGE(all.ok(), all.error().sentence());
  return std::move(all).value();
}

}  // namespace

TEST_CASE("a body and things: the distance is the least of all, without tables to the bit") {
  const BodyProxy body = made(sample_data(1, 9, false));
  const BodyProxy things[] = {made(beside(body.data(), 2, 0.5, false)),
                              made(beside(body.data(), 3, -1.0, false))};
  const BodyProxy all = joined(body, things);
  bodice::engine::Random random(4);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0));
    const double least = std::min({proxy_distance(body, p).distance, proxy_distance(things[0], p).distance,
                                   proxy_distance(things[1], p).distance});
    CHECK(proxy_distance(all, p).distance == least);
  }
}

TEST_CASE("tables stay those of their ellipsoids, beyond the blend to the bit") {
  const BodyProxy body = made(sample_data(5));
  const BodyProxy thing = made(beside(body.data(), 6, 9.0, true));
  const BodyProxy all = joined(body, {&thing, 1});
  bodice::engine::Random random(7);
  for (int i = 0; i < 300; ++i) {
    const double x = i % 2 == 0 ? 0.0 : 9.0;
    const Vec3 p(x + random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0));
    const ProxyDistance alone = proxy_distance(i % 2 == 0 ? body : thing, p), now = proxy_distance(all, p);
    CHECK(now.distance == alone.distance);
    CHECK(now.owner == alone.owner + (i % 2 == 0 ? 0 : body.ellipsoids().size()));
  }
  CHECK(from_json(to_json(all))->hash() == all.hash());
  CHECK(from_binary(to_binary(all))->hash() == all.hash());
}

TEST_CASE("things without the tables, the stature or the margin of the body are refused") {
  const BodyProxy body = made(sample_data(8));
  const auto refused = [&](auto change) {
    BodyProxy::Data data = beside(body.data(), 9, 1.0, true);
    change(data);
    const BodyProxy thing = made(std::move(data));
    const auto all = add_things(body, {&thing, 1});
    return !all.ok() && all.error().code == bodice::engine::ErrorCode::kInvalidArgument;
  };
  CHECK_FALSE(refused([](BodyProxy::Data&) {}));
  CHECK(refused([](BodyProxy::Data& d) { d.stature_m *= 1.1; }));
  CHECK(refused([](BodyProxy::Data& d) { d.margin_m += 1e-4; }));
  CHECK(refused([](BodyProxy::Data& d) {
    d.tier = Tier::kTight;
    d.relief.clear();
    d.texels.clear();
  }));
}
