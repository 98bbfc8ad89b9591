// Base poses: the tables of a bound proxy, solved anew for poses in which tables carried from rest are too
// inaccurate.
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

/// A prepared clip gets another base pose where its joints are turned farther than this from every earlier
/// one.
inline constexpr double kPreparedTurn_rad = 0.2;

/// Prepares a clip: makes base poses along it, in the order of their times. No pose of the clip is then
/// farther than kPreparedTurn_rad from rest or from a base pose. There are at most 64 base poses, so that
/// poses late in a long clip may be farther. Each is named by the clip and its second. The clip after
/// `until_s` is left out. Fails as make_base_pose() does. Cost: make_base_pose() for each; `progress` reports
/// the stage "prepare".
engine::Result<proxy::BasePoses> make_base_poses(const engine::Context& context,
                                                 const proxy::BodyProxy& bound, const SegmentedSkin& skin,
                                                 const BodyMotion& motion,
                                                 double until_s = std::numeric_limits<double>::infinity(),
                                                 const Progress& progress = {});

}  // namespace bodice::tryon
