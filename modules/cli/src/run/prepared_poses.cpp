#include "run/prepared_poses.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include <bodice/io/rig.hpp>
#include <bodice/rigging/motion.hpp>
#include <bodice/tryon/base_pose.hpp>

namespace bodice::inline v0_1::cli {
namespace {

/// The pose of a made motion that is farthest from standing, seconds.
double far_pose_s(const std::string& name) {
  const auto motion = rigging::motion_from_name(name);
  if (motion == rigging::Motion::kSit) return 2.5;
  if (motion == rigging::Motion::kSquat || motion == rigging::Motion::kArmsUp) return 1.5;
  if (motion == rigging::Motion::kReach) return 1.0;
  return 0.0;
}

/// A pose of the command line.
struct NamedPose {
  std::string motion;
  double time_s = 0.0;
};

std::optional<NamedPose> parse(const std::string& text) {
  const std::size_t at = text.rfind('@');
  if (at == std::string::npos) return NamedPose{text, far_pose_s(text)};
  NamedPose pose{text.substr(0, at), 0.0};
  const char* const end = text.data() + text.size();
  const auto [read, error] = std::from_chars(text.data() + at + 1, end, pose.time_s);
  if (error != std::errc() || read != end || pose.motion.empty()) return std::nullopt;
  return pose;
}

bool same_joints(const rig::Skeleton& skeleton, const proxy::Binding& binding) {
  return std::ranges::equal(skeleton.joints, binding.joint_names, {}, &rig::Joint::name);
}

}  // namespace

engine::Result<proxy::BasePoses> prepare_poses(const engine::Context& context,
                                               const tryon::PreparedBody& body, const PosesToPrepare& wanted,
                                               std::vector<engine::Warning>& warnings) {
  proxy::BasePoses bases;
  for (const std::string& text : wanted.poses) {
    const auto pose = parse(text);
    if (!pose)
      return engine::Error{engine::ErrorCode::kInvalidArgument,
                           "--poses " + text + ": what follows the last @ is not a number of seconds.",
                           "Give motions as in sit, or sit@2.5."};
    auto motion = tryon::find_motion(context, body.skin, {.motion = pose->motion, .clip = ""}, warnings);
    if (!motion) return std::move(motion).error();
    if (auto inside = tryon::check_time(motion->clip, pose->time_s); !inside) return inside.error();
    std::vector<rig::Affine> world(motion->rig.skeleton.joints.size());
    rig::joint_matrices(motion->rig.skeleton, motion->clip, pose->time_s, world);
    auto base = tryon::make_base_pose(context, body.fit.proxy, body.skin, world, text);
    if (!base) return std::move(base).error();
    bases.push_back(std::move(base).value());
  }
  if (wanted.motion.motion.empty()) return bases;
  auto motion = tryon::find_motion(context, body.skin, wanted.motion, warnings);
  if (!motion) return std::move(motion).error();
  auto along = tryon::make_base_poses(context, body.fit.proxy, body.skin, *motion);
  if (!along) return along;
  bases.insert(bases.end(), along->begin(), along->end());
  return bases;
}

engine::Result<std::shared_ptr<const proxy::BasePose>> refit_for(const engine::Context& context,
                                                                 const proxy::BodyProxy& bound,
                                                                 const std::string& body_file,
                                                                 std::span<const proxy::JointMatrix> joints) {
  auto read = io::import_rigged_body(context, body_file);
  if (!read) return std::move(read).error();
  if (!read->rig || !bound.binding() || !same_joints(read->rig->skeleton, *bound.binding()))
    return engine::Error{engine::ErrorCode::kInvalidArgument,
                         body_file + ": the body in this file is not moved by the joints of the proxy.",
                         "Name the file that the proxy was fitted to with --body."};
  tryon::SegmentedSkin skin;
  skin.input = std::move(read->body);
  skin.anatomy.part.assign(skin.input.skin.positions.size(), body::Part::kHead);  // a refit is of all parts
  skin.rig = std::make_shared<const rig::Rig>(std::move(read->rig).value());
  return tryon::make_base_pose(context, bound, skin, joints, "refit");
}

}  // namespace bodice::cli
