// Base poses: the tables of a bound proxy solved anew where those carried from rest err too much.
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <string>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/proxy/base_pose.hpp>
#include <bodice/tryon/motion.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::inline v0_1::tryon {

/// Solves the tables of a bound proxy for the skin in one pose; `world` is joint space to world of each
/// joint, #J. Its ellipsoids stay as they are carried. Fails with kInvalidArgument where the skin has no rig,
/// the proxy is not bound or has no tables, or a matrix is refused as by binding::Poser::pose(). The same
/// bits for any number of workers. Takes some tenths of a second of one core.
engine::Result<std::shared_ptr<const proxy::BasePose>> make_base_pose(const engine::Context& context,
                                                                      const proxy::BodyProxy& bound,
                                                                      const SegmentedSkin& skin,
                                                                      std::span<const rig::Affine> world,
                                                                      std::string name);

/// Joints that are turned farther than this from every base pose of a prepared clip get another one.
inline constexpr double kPreparedTurn_rad = 0.2;

/// Prepares a clip that is known beforehand: base poses along it, in the order of their times, so that no
/// pose of it is farther than kPreparedTurn_rad from rest or one of them (at most 64 of them; then poses late
/// in the clip are farther). Named by the clip and the second. What follows `until_s` is left out. Fails as
/// make_base_pose() does. Takes as long as that for each; `progress` gets "prepare".
engine::Result<proxy::BasePoses> make_base_poses(const engine::Context& context,
                                                 const proxy::BodyProxy& bound, const SegmentedSkin& skin,
                                                 const BodyMotion& motion,
                                                 double until_s = std::numeric_limits<double>::infinity(),
                                                 const Progress& progress = {});

}  // namespace bodice::tryon
