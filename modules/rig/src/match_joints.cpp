#include "match_joints.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "joint_names.hpp"
#include "rest_frames.hpp"

namespace bodice::inline v0_1::rig {

namespace {

/// Joints from `ancestor` down to `joint`, both included; empty where it is no ancestor.
std::vector<std::size_t> path_down(const Skeleton& skeleton, std::size_t ancestor, std::size_t joint) {
  std::vector<std::size_t> path = {joint};
  while (path.back() != ancestor) {
    const std::int32_t parent = skeleton.joints[path.back()].parent;
    if (parent < 0) return {};
    path.push_back(static_cast<std::size_t>(parent));
  }
  std::reverse(path.begin(), path.end());
  return path;
}

/// How far along a path each of its joints lies, 0 to 1 by length.
std::vector<double> fractions(const RestFrames& rest, const std::vector<std::size_t>& path) {
  std::vector<double> along = {0.0};
  for (std::size_t i = 1; i < path.size(); ++i)
    along.push_back(along.back() + (rest.position[path[i]] - rest.position[path[i - 1]]).norm());
  const double length = along.back();
  for (double& fraction : along) fraction = length > 0.0 ? fraction / length : 0.0;
  return along;
}

class Matcher {
 public:
  Matcher(const Skeleton& source, const Skeleton& target)
      : source_(source),
        target_(target),
        source_rest_(rest_frames(source)),
        target_rest_(rest_frames(target)) {}

  JointMatch run() {
    match_.source_of.assign(target_.joints.size(), kNoIndex);
    match_.name.resize(target_.joints.size());
    by_name();
    const std::vector<std::size_t> named = match_.source_of;
    for (std::size_t j = 0; j < target_.joints.size(); ++j)
      if (named[j] != kNoIndex) fill_above(j, named);
    return std::move(match_);
  }

 private:
  void by_name() {
    const std::vector<std::string> source_names = common_joint_names(source_);
    const std::vector<std::string> target_names = common_joint_names(target_);
    std::map<std::string, std::size_t> common, own;
    for (std::size_t j = 0; j < source_names.size(); ++j) {
      common.emplace(source_names[j], j);
      own.emplace(source_.joints[j].name, j);
      if (source_names[j] == "hips") match_.source_hips = j;
    }
    for (std::size_t j = 0; j < target_names.size(); ++j) {
      if (target_names[j] == "hips") match_.target_hips = j;
      const std::string& name = target_names[j].empty() ? target_.joints[j].name : target_names[j];
      const auto& table = target_names[j].empty() ? own : common;
      const auto found = name.empty() ? table.end() : table.find(name);
      if (found == table.end()) continue;
      match_.source_of[j] = found->second;
      match_.name[j] = target_names[j];
      ++match_.count;
    }
  }

  /// The joints without a name in common between a matched joint and the matched one above it.
  void fill_above(std::size_t joint, const std::vector<std::size_t>& named) {
    std::int32_t above = target_.joints[joint].parent;
    while (above >= 0 && named[static_cast<std::size_t>(above)] == kNoIndex)
      above = target_.joints[static_cast<std::size_t>(above)].parent;
    if (above < 0 || above == target_.joints[joint].parent) return;
    const std::size_t top = static_cast<std::size_t>(above);
    const std::vector<std::size_t> to = path_down(target_, top, joint);
    const std::vector<std::size_t> from = path_down(source_, named[top], named[joint]);
    if (from.empty()) return;
    const std::vector<double> to_along = fractions(target_rest_, to),
                              from_along = fractions(source_rest_, from);
    for (std::size_t i = 1; i + 1 < to.size(); ++i) {
      if (match_.source_of[to[i]] != kNoIndex) continue;  // on the path to several matched joints: the first
      std::size_t k = from.size() - 1;
      while (k > 0 && (from_along[k] > to_along[i] || k + 1 == from.size())) --k;
      match_.source_of[to[i]] = from[k];
    }
  }

  const Skeleton& source_;
  const Skeleton& target_;
  const RestFrames source_rest_, target_rest_;
  JointMatch match_;
};

}  // namespace

JointMatch match_joints(const Skeleton& source, const Skeleton& target) {
  return Matcher(source, target).run();
}

}  // namespace bodice::rig
