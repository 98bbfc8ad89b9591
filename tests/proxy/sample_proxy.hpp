#pragma once

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include <bodice/engine/random.hpp>
#include <bodice/proxy/body_proxy.hpp>

namespace bodice_test {

/// Random but valid data that use every field.
inline bodice::proxy::BodyProxy::Data sample_data(std::uint64_t seed, int ellipsoids = 12,
                                                  bool relief = true) {
  using namespace bodice;
  engine::Random random(seed);
  proxy::BodyProxy::Data data;
  data.tier = relief ? proxy::Tier::kRelief : proxy::Tier::kTight;
  data.stature_m = random.uniform(1.4, 2.0);
  data.margin_m = random.uniform(-1e-3, 1e-3);
  data.source_hash = random.bits();
  for (int i = 0; i < ellipsoids; ++i) {
    proxy::ProxyEllipsoid e;
    for (int k = 0; k < 3; ++k) e.shape.center[k] = random.uniform(-2.0, 2.0);
    for (int k = 0; k < 3; ++k) e.shape.radii[k] = std::exp(random.uniform(-5.0, 0.0));
    e.shape.axes = Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal())
                       .normalized()
                       .toRotationMatrix();
    e.part = static_cast<body::Part>(random.below(body::kPartCount));
    e.bone = static_cast<std::int16_t>(random.below(50)) - 1;
    data.ellipsoids.push_back(e);
    if (!relief) continue;
    const auto n = static_cast<std::uint16_t>(i % 3 == 0 ? 0 : 2 + random.below(7));
    auto small = [&] { return static_cast<float>(random.uniform(-0.02, 0.02)); };
    data.relief.push_back(
        {n, small(), small(), small(), small(), static_cast<std::uint32_t>(data.texels.size())});
    for (int t = 0; t < n * n; ++t)
      data.texels.push_back(
          {static_cast<std::uint8_t>(random.below(256)), static_cast<std::uint8_t>(random.below(256))});
  }
  return data;
}

/// The proxy of data that are valid.
inline bodice::proxy::BodyProxy made(bodice::proxy::BodyProxy::Data data) {
  auto proxy = bodice::proxy::BodyProxy::make(std::move(data));
  REQUIRE_MESSAGE(proxy.ok(), proxy.error().sentence());
  return std::move(proxy).value();
}

}  // namespace bodice_test
