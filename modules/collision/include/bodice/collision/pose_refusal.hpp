// Why a collider refuses a pose: for messages, after Collider::move_to() returned false.
#pragma once

#include <optional>
#include <span>

#include <bodice/engine/result.hpp>
#include <bodice/geometry/ellipsoid.hpp>
#include <bodice/proxy/body_proxy.hpp>

namespace bodice::inline v0_1::collision {

/// What Collider::move_to() refuses in a pose (world, meters) of a collider that was made from `proxy`: a
/// sentence with the first unfit ellipsoid, its part, the joint that moves it, and the reason. Nothing where
/// the pose is taken. Cost: as move_to(). Thread-safe.
std::optional<engine::Error> why_refused(const proxy::BodyProxy& proxy,
                                         std::span<const geometry::Ellipsoid> shapes);

}  // namespace bodice::collision
