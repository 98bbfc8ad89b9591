#include "run/motion_time.hpp"

#include <algorithm>
#include <optional>

#include <bodice/engine/message.hpp>
#include <bodice/io/rig.hpp>

namespace bodice::inline v0_1::cli {
namespace {

bool moves_skin(const proxy::Binding& binding, std::size_t joint) {
  return std::ranges::any_of(binding.terms,
                             [&](const proxy::CarryTerm& term) { return term.joint == joint; });
}

}  // namespace

engine::Result<std::vector<proxy::JointMatrix>> joints_at(const engine::Context& context,
                                                          const proxy::Binding& binding,
                                                          const MotionTime& motion) {
  auto read = io::import_motion(context, motion.choice.motion);
  if (!read) return std::move(read).error();
  const auto clip = tryon::choose_clip(motion.choice, read->clips);
  if (!clip) return clip.error();
  if (auto inside = tryon::check_time(*clip, motion.time_s); !inside) return inside.error();
  std::vector<rig::Affine> world(read->skeleton.joints.size());
  rig::joint_matrices(read->skeleton, *clip, motion.time_s, world);
  std::vector<proxy::JointMatrix> joints(binding.bind.size(), rig::identity());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const std::optional<std::size_t> from = rig::find_joint(read->skeleton, binding.joint_names[j]);
    if (!from && moves_skin(binding, j))
      return engine::Error{engine::ErrorCode::kNotFound,
                           motion.choice.motion + ": there is no joint '" + binding.joint_names[j] +
                               "', which moves skin of the proxy.",
                           "Name a motion of the skeleton that the body was fitted with."};
    if (!from) continue;
    const rig::Affine skinning = rig::compose(world[*from], rig::inverse(read->skeleton.joints[*from].bind));
    joints[j] = rig::compose(skinning, binding.bind[j]);
  }
  return joints;
}

}  // namespace bodice::cli
