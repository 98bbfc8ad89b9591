#include <bodice/rig/rig.hpp>

#include <algorithm>
#include <string>
#include <utility>

#include "skeleton_errors.hpp"

namespace bodice::inline v0_1::rig {

namespace {

constexpr std::size_t kUnplaced = ~std::size_t{0};

/// For each joint in the new order, its index in the old one.
engine::Result<std::vector<std::size_t>> order_of(const Skeleton& skeleton) {
  const std::size_t count = skeleton.joints.size();
  std::vector<std::size_t> order, position(count, kUnplaced), chain;
  for (std::size_t j = 0; j < count; ++j) {
    chain.clear();
    for (std::size_t at = j; position[at] == kUnplaced;) {
      if (chain.size() > count)
        return unusable(
            joint_label(skeleton, j) + " is its own ancestor: the parents of joints run in a circle.",
            "Give one joint of the circle the parent -1.");
      chain.push_back(at);
      const std::int32_t parent = skeleton.joints[at].parent;
      if (parent == kNoParent) break;
      if (parent < 0 || static_cast<std::size_t>(parent) >= count)
        return unusable(joint_label(skeleton, at) + " has the parent " + std::to_string(parent) +
                            ", which does not exist.",
                        "Give the index of another joint, or -1 for a root.");
      at = static_cast<std::size_t>(parent);
    }
    for (auto at = chain.rbegin(); at != chain.rend(); ++at) {
      position[*at] = order.size();
      order.push_back(*at);
    }
  }
  return order;
}

}  // namespace

engine::Result<std::vector<engine::Warning>> mend(Rig& rig, std::size_t vertices) {
  if (auto checked = validate(rig.skeleton); !checked) return checked.error();
  for (const Clip& clip : rig.clips)
    if (auto checked = validate(clip, rig.skeleton); !checked) return checked.error();
  return mend(rig.weights, rig.skeleton, vertices);
}

engine::Result<void> put_parents_first(Rig& rig) {
  if (rig.skeleton.joints.size() > kMaxJoints) return validate(rig.skeleton);
  const auto order = order_of(rig.skeleton);
  if (!order) return order.error();
  std::vector<std::uint16_t> now(order->size());
  std::vector<Joint> joints(order->size());
  for (std::size_t i = 0; i < order->size(); ++i) now[(*order)[i]] = static_cast<std::uint16_t>(i);
  for (std::size_t i = 0; i < order->size(); ++i) {
    joints[i] = std::move(rig.skeleton.joints[(*order)[i]]);
    if (joints[i].parent != kNoParent) joints[i].parent = now[static_cast<std::size_t>(joints[i].parent)];
  }
  rig.skeleton.joints = std::move(joints);
  for (std::uint16_t& joint : rig.weights.joint)
    if (joint < now.size()) joint = now[joint];
  for (Clip& clip : rig.clips) {
    for (Track& track : clip.tracks)
      if (track.joint < now.size()) track.joint = now[track.joint];
    std::stable_sort(clip.tracks.begin(), clip.tracks.end(),
                     [](const Track& a, const Track& b) { return a.joint < b.joint; });
  }
  return {};
}

}  // namespace bodice::rig
