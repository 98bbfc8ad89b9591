#include "import/rig/build_skeleton.hpp"

#include <algorithm>
#include <string>

#include <bodice/geometry/decompositions.hpp>

namespace bodice::inline v0_1::io {

namespace {

using rig::Affine;
using rig::Joint;
using rig::LocalTransform;
using rig::Mat3;
using rig::Vec3;

/// A linear map as `stretch * rotation`, where the columns of `stretch` are orthogonal.
struct ShearSplit {
  Mat3 stretch;
  Mat3 rotation;
};

ShearSplit split_shear(const Mat3& linear) {
  const geometry::SingularValues svd = geometry::singular_values(linear);
  if (!svd.is_valid) return {linear, Mat3::Identity()};  // its squares overflow
  // A mirror stands on both sides, so that it cancels.
  const double mirror = svd.v.determinant() < 0.0 ? -1.0 : 1.0;
  ShearSplit split{mirror * svd.u, mirror * svd.v.transpose()};
  for (int k = 0; k < 3; ++k) split.stretch.col(k) *= svd.values[k];
  return split;
}

constexpr std::uint16_t kNoJoint = 65535;

/// A map of file space as one of meters, y up: roots and bind matrices are turned, all lengths are scaled.
struct ToInside {
  Mat3 turn;
  Eigen::Quaterniond rotation;
  double meters_per_unit;

  Affine inner(const Affine& map) const {
    return rig::affine(rig::linear_of(map), meters_per_unit * map.col(3));
  }
  Affine outer(const Affine& map) const {
    return rig::affine(turn * rig::linear_of(map), meters_per_unit * (turn * map.col(3)));
  }
};

ToInside to_inside(const FileRig& file, const geometry::Frame& frame) {
  const Mat3 turn = frame.rotation();
  return {turn, Eigen::Quaterniond(turn), frame.meters_per_unit * file.world_to_file(0, 0)};
}

/// Converts the keys of one joint to meters, y up; keys of a root are rotated with it.
rig::Track to_inside(rig::Track track, const ToInside& to, bool is_root) {
  for (Vec3& t : track.translation.value) t = to.meters_per_unit * (is_root ? Vec3(to.turn * t) : t);
  if (is_root)
    for (rig::Quaternion& q : track.rotation.value) q = to.rotation * q;
  return track;
}

std::vector<bool> animated_nodes(const FileRig& file) {
  std::vector<bool> animated(file.nodes.size());
  for (const FileClip& clip : file.clips)
    for (const auto& [node, track] : clip.tracks) animated[node] = true;
  return animated;
}

/// Marks the nodes that become joints, by the rule of build_skeleton().
std::vector<bool> wanted_nodes(const FileRig& file, const std::vector<bool>& used) {
  const std::vector<bool> animated = animated_nodes(file);
  std::vector<bool> wanted(file.nodes.size());
  for (std::size_t b = 0; b < used.size(); ++b)
    if (used[b]) wanted[file.bindings[b].node] = true;
  const std::vector<bool> bound = wanted;
  for (std::size_t n = 0; n < wanted.size(); ++n) {
    const FileNode& node = file.nodes[n];
    const bool below = node.parent >= 0 && wanted[static_cast<std::size_t>(node.parent)] &&
                       rig::is_invertible(node.local.topRows<3>());
    wanted[n] = wanted[n] || node.is_bone || below || (!file.has_bones && animated[n]);
  }
  for (std::size_t n = wanted.size(); n-- > 1;)
    if (wanted[n] && file.nodes[n].parent >= 0) wanted[static_cast<std::size_t>(file.nodes[n].parent)] = true;
  for (std::size_t n = 0; n < wanted.size(); ++n) {  // what stands above all bones and does nothing
    const FileNode& node = file.nodes[n];
    const bool on_joint = node.parent >= 0 && wanted[static_cast<std::size_t>(node.parent)];
    if (!on_joint && !bound[n] && !animated[n] && !node.is_bone && node.local.isIdentity(0.0))
      wanted[n] = false;
  }
  return wanted;
}

class SkeletonBuilder {
 public:
  SkeletonBuilder(const FileRig& file, const std::vector<bool>& used, const geometry::Frame& frame)
      : file_(file),
        used_(used),
        to_(to_inside(file, frame)),
        joint_of_(file.nodes.size(), kNoJoint),
        keyed_joint_of_(file.nodes.size(), kNoJoint) {}

  engine::Result<BuiltSkeleton> build() {
    const std::vector<bool> wanted = wanted_nodes(file_, used_);
    for (std::size_t n = 0; n < file_.nodes.size(); ++n) {
      if (!wanted[n]) continue;
      if (is_full()) break;
      add_node(n);
    }
    bind();
    if (is_full())
      return engine::Error{engine::ErrorCode::kUnusableGeometry,
                           "The file has more than " + std::to_string(rig::kMaxJoints - 3) + " joints.",
                           "Remove joints that move no skin."};
    if (auto checked = validate(out_.skeleton); !checked) return checked.error();
    add_clips();
    return std::move(out_);
  }

 private:
  std::vector<Joint>& joints() { return out_.skeleton.joints; }
  bool is_full() const { return out_.skeleton.joints.size() + 2 >= rig::kMaxJoints; }  // a node may need two

  std::uint16_t add_joint(std::string name, std::int32_t parent, const Affine& local) {
    Joint joint;
    joint.name = std::move(name);
    joint.parent = parent;
    joint.local = rig::to_local_transform(local);
    joints().push_back(std::move(joint));
    return static_cast<std::uint16_t>(joints().size() - 1);
  }

  /// A map with shear is U D V^T: a turned joint with a scale, and a turned one on it.
  void add_node(std::size_t n) {
    const FileNode& node = file_.nodes[n];
    const bool is_root = node.parent < 0 || joint_of_[static_cast<std::size_t>(node.parent)] == kNoJoint;
    const std::int32_t parent = is_root ? rig::kNoParent : joint_of_[static_cast<std::size_t>(node.parent)];
    const Affine file_local = node.local.topRows<3>();
    const Affine local = is_root ? to_.outer(file_local) : to_.inner(file_local);
    if (!local.allFinite() || !rig::has_shear(local)) {
      keyed_joint_of_[n] = joint_of_[n] = add_joint(node.name, parent, local);
      return;
    }
    const ShearSplit split = split_shear(rig::linear_of(local));
    keyed_joint_of_[n] = add_joint(node.name + " (shear)", parent, rig::affine(split.stretch, local.col(3)));
    joint_of_[n] = add_joint(node.name, keyed_joint_of_[n], rig::affine(split.rotation, Vec3::Zero()));
  }

  /// The first used bind pose of a node is its joint's; others get joints of their own that stand on it.
  void bind() {
    std::vector<bool> bound(joints().size());
    out_.joint_of_binding.assign(file_.bindings.size(), kNoJoint);
    for (const bool used : {true, false})
      for (std::size_t b = 0; b < file_.bindings.size(); ++b)
        if (used_[b] == used) bind_to(b, bound);
    bind_the_rest(bound);
  }

  void bind_to(std::size_t b, std::vector<bool>& bound) {
    const FileBinding& binding = file_.bindings[b];
    std::uint16_t joint = joint_of_[binding.node];
    if (joint == kNoJoint || is_full() || (bound[joint] && !used_[b])) return;
    if (bound[joint]) {
      joint = add_joint(joints()[joint].name + " (bind " + std::to_string(b) + ")", joint, rig::identity());
      bound.push_back(true);
    }
    bound[joint] = true;
    joints()[joint].bind = to_.outer(binding.bind.topRows<3>());
    out_.joint_of_binding[b] = joint;
  }

  /// A joint that skins nothing stands to its parent's bind pose as it stands to its parent at rest.
  void bind_the_rest(std::vector<bool>& bound) {
    std::vector<Affine> world(joints().size());
    rest_matrices(out_.skeleton, world);
    for (std::size_t j = 0; j < joints().size(); ++j) {
      if (bound[j]) continue;
      const std::int32_t parent = joints()[j].parent;
      joints()[j].bind = parent < 0 ? world[j]
                                    : rig::compose(joints()[static_cast<std::size_t>(parent)].bind,
                                                   rig::to_affine(joints()[j].local));
    }
  }

  void add_clips() {
    for (const FileClip& from : file_.clips) {
      rig::Clip clip;
      clip.name = from.name.empty() ? "clip " + std::to_string(out_.clips.size() + 1) : from.name;
      clip.duration_s = from.duration_s;
      for (const auto& [node, track] : from.tracks) add_track(node, track, clip);
      std::stable_sort(clip.tracks.begin(), clip.tracks.end(),
                       [](const rig::Track& a, const rig::Track& b) { return a.joint < b.joint; });
      if (clip.tracks.empty() && from.flaw.empty()) continue;  // moves nothing of the skeleton
      const auto checked = validate(clip, out_.skeleton);
      if (from.flaw.empty() && checked.ok()) {
        out_.clips.push_back(std::move(clip));
        continue;
      }
      const std::string why = from.flaw.empty() ? checked.error().message : from.flaw + ".";
      out_.warnings.push_back({"clip-left-out", clip.name,
                               "The clip '" + clip.name + "' was left out: " + why,
                               "Mend the clip's keys and export it again."});
    }
  }

  void add_track(std::uint32_t node, const rig::Track& track, rig::Clip& clip) {
    const std::uint16_t joint = keyed_joint_of_[node];
    if (joint == kNoJoint || (track.translation.empty() && track.rotation.empty() && track.scale.empty()))
      return;
    clip.tracks.push_back(to_inside(track, to_, joints()[joint].parent < 0));
    clip.tracks.back().joint = joint;
    if (joint_of_[node] == joint) return;
    rig::Track still;  // keys replace the node's matrix, and with it the shear
    still.joint = joint_of_[node];
    still.rotation = {rig::Interpolation::kStep, {0.0}, {Eigen::Quaterniond::Identity()}};
    still.scale = {rig::Interpolation::kStep, {0.0}, {Vec3::Ones()}};
    clip.tracks.push_back(std::move(still));
  }

  const FileRig& file_;
  const std::vector<bool>& used_;
  const ToInside to_;
  std::vector<std::uint16_t> joint_of_, keyed_joint_of_;  // of each node; two joints where it has a shear
  BuiltSkeleton out_;
};

}  // namespace

engine::Result<BuiltSkeleton> build_skeleton(const FileRig& file, const std::vector<bool>& used,
                                             const geometry::Frame& frame) {
  return SkeletonBuilder(file, used, frame).build();
}

}  // namespace bodice::io
