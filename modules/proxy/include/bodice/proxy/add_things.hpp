// A body proxy and things beside it as one proxy, for a collider takes one.
#pragma once

#include <span>
#include <string_view>

#include <bodice/proxy/base_pose.hpp>
#include <bodice/proxy/body_proxy.hpp>

namespace bodice::inline v0_1::proxy {

/// The joint of a bound proxy that things beside the body hang on: the last one. It has no parent, and its
/// matrix is the identity in every pose.
inline constexpr std::string_view kStillJoint = "still";

/// The ellipsoids and tables of a body, then those of the things where they are. The distance of the result
/// is the least of all; with relief, distances are blended where a body's ellipsoid and a thing's are within
/// the blend of each other. A bound body stays bound, and has kStillJoint as one joint more. Fails with
/// kInvalidArgument unless stature, margin and having tables are the body's: fit the things with the stature
/// of the body. O(size of all).
engine::Result<BodyProxy> add_things(const BodyProxy& body, std::span<const BodyProxy> things);

/// A base pose of a body for `all`, the body with its things, which keep their tables. Costs O(size of
/// `all`).
BasePose with_things(const BasePose& of_body, const BodyProxy& all);

}  // namespace bodice::proxy
