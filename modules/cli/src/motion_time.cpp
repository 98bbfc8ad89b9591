#include "motion_time.hpp"

#include <algorithm>
#include <optional>

#include <bodice/engine/message.hpp>
#include <bodice/io/rig.hpp>

namespace bodice::cli {
namespace {

/// The clip of this name, or the first; null if there is none.
const rig::Clip* find_clip(const std::vector<rig::Clip>& clips, const std::string& name) {
  if (name.empty()) return clips.empty() ? nullptr : &clips.front();
  const auto found = std::ranges::find(clips, name, &rig::Clip::name);
  return found == clips.end() ? nullptr : &*found;
}

engine::Error no_clip(const MotionTime& motion, const std::vector<rig::Clip>& clips) {
  std::string names;
  for (const rig::Clip& clip : clips) names += (names.empty() ? "'" : ", '") + clip.name + "'";
  if (names.empty())
    return {engine::ErrorCode::kNotFound, motion.file + ": there is no clip in it.",
            "Name a file with clips."};
  return {engine::ErrorCode::kNotFound, motion.file + ": there is no clip '" + motion.clip + "'.",
          "Its clips are " + names + "."};
}

bool moves_skin(const proxy::Binding& binding, std::size_t joint) {
  return std::ranges::any_of(binding.terms,
                             [&](const proxy::CarryTerm& term) { return term.joint == joint; });
}

}  // namespace

engine::Result<std::vector<proxy::JointMatrix>> joints_at(const engine::Context& context,
                                                          const proxy::Binding& binding,
                                                          const MotionTime& motion) {
  auto read = io::import_motion(context, motion.file);
  if (!read) return std::move(read).error();
  const rig::Clip* const clip = find_clip(read->clips, motion.clip);
  if (!clip) return no_clip(motion, read->clips);
  std::vector<rig::Affine> world(read->skeleton.joints.size());
  rig::joint_matrices(read->skeleton, *clip, motion.time_s, world);
  std::vector<proxy::JointMatrix> joints(binding.bind.size(), rig::identity());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const std::optional<std::size_t> from = rig::find_joint(read->skeleton, binding.joint_names[j]);
    if (!from && moves_skin(binding, j))
      return engine::Error{engine::ErrorCode::kNotFound,
                           motion.file + ": there is no joint '" + binding.joint_names[j] +
                               "', which moves skin of the proxy.",
                           "Name a motion of the skeleton that the body was fitted with."};
    if (!from) continue;
    const rig::Affine skinning = rig::compose(world[*from], rig::inverse(read->skeleton.joints[*from].bind));
    joints[j] = rig::compose(skinning, binding.bind[j]);
  }
  return joints;
}

}  // namespace bodice::cli
