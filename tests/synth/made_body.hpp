// A made body and its joints and landmarks, for tests.
#pragma once

#include <string_view>

#include <doctest/doctest.h>
#include <bodice/synth/body.hpp>

namespace bodice_test {

using bodice::geometry::Vec3;

inline bodice::synth::Body made(const bodice::synth::BodyOptions& options,
                                const bodice::engine::Context& context = {}) {
  auto body = bodice::synth::make_body(context, options);
  REQUIRE_MESSAGE(body.ok(), (body.ok() ? "" : body.error().sentence()));
  return std::move(body).value();
}

inline Vec3 joint(const bodice::synth::Body& body, std::string_view name) {
  for (const bodice::synth::Joint& j : body.joints)
    if (j.name == name) return j.position;
  FAIL("no joint of that name");
  return Vec3::Zero();
}

inline Vec3 mark(const bodice::synth::Body& body, bodice::body::LandmarkId id) {
  return body.landmarks[static_cast<std::size_t>(id)].position;
}

}  // namespace bodice_test
