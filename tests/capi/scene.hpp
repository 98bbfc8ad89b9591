// Handles that release themselves, and a limb with particles around it, for the suite of the C interface.
#pragma once

#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <bodice.hpp>
#include <bodice/proxy/proxy_file.hpp>
#include <bodice_test/allocations.hpp>

#include "collision/scenes.hpp"

namespace capi_test {

using bodice_test::Cloud;

inline bodice::Context make_context(int workers = 1) {
  bodice_context_options options = bodice_default_context_options();
  options.workers = workers;
  auto context = bodice::Context::create(options);
  REQUIRE_MESSAGE(context, bodice_last_error());
  return std::move(*context);
}

inline bodice::Proxy make_proxy(const bodice::Context& context, const bodice::proxy::BodyProxy& proxy) {
  const std::vector<std::byte> bytes = bodice::proxy::to_binary(proxy);
  auto made = bodice::Proxy::from_bytes(context, bytes.data(), bytes.size());
  REQUIRE_MESSAGE(made, bodice_last_error());
  return std::move(*made);
}

/// One collider in C++ and one of the same proxy behind the C interface.
struct Scene {
  bodice::proxy::BodyProxy engine_proxy;
  bodice::collision::Collider engine;
  bodice::Context context;
  bodice::Proxy proxy;
  bodice::Collider collider;
  bodice::Workspace workspace;

  explicit Scene(const bodice::proxy::BodyProxy& made, int workers = 1)
      : engine_proxy(made), engine(made), context(make_context(workers)), proxy(make_proxy(context, made)) {
    auto created = bodice::Collider::create(context, proxy);
    REQUIRE_MESSAGE(created, bodice_last_error());
    collider = std::move(*created);
    workspace = std::move(*bodice::Workspace::create(context));
  }
};

/// What the collider behind the C interface finds for these points of the world, one contact each.
inline std::vector<bodice_contact> contacts_at(Scene& scene, const std::vector<bodice_test::Vec3>& points) {
  std::vector<bodice_contact> found(points.size());
  bodice_contacts to = bodice_default_contacts();
  to.contact = found.data();
  const bodice::Points given(points.size(), points.front().data(), sizeof(bodice_test::Vec3));
  REQUIRE_MESSAGE(scene.collider.query(given, scene.workspace, to) == BODICE_OK, bodice_last_error());
  return found;
}

inline bodice::proxy::BodyProxy limb_proxy(bool relief) {
  const auto data = bodice_test::data_of(bodice_test::limb());
  return bodice_test::proxy_of(relief ? bodice_test::with_relief(data, 8, 0.002, 7) : data);
}

/// Particles in and around the limb, in the engine's local frame, with velocities and safe positions.
inline Cloud cloud_around_limb(std::size_t count, std::uint64_t seed) {
  bodice::engine::Random random(seed);
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    bodice_test::Vec3 p = bodice_test::random_vector(random, 0.1);
    p.x() *= 4.0;
    cloud.add(p, bodice_test::random_vector(random, 1.0));
    cloud.add_safe(p + bodice_test::Vec3(0.0, 0.2, 0.0));
  }
  return cloud;
}

}  // namespace capi_test
