// Based on: Michael Gleicher. Retargetting Motion to New Characters. 1998.
// Differs: no constraints are solved: world rotations relative to rest are carried over, limbs aligned by
// direction.
#include <bodice/rig/retarget.hpp>

#include <algorithm>
#include <limits>
#include <set>

#include "match_joints.hpp"
#include "rest_frames.hpp"
#include "skeleton_errors.hpp"

namespace bodice::inline v0_1::rig {

namespace {

using Eigen::Quaterniond;

/// All times at which a track of the clip has a key inside the clip, and both ends.
std::vector<double> key_times(const Clip& clip) {
  std::set<double> times = {0.0, clip.duration_s};
  const auto add = [&](const std::vector<double>& keys) {
    for (const double t : keys)
      if (t > 0.0 && t < clip.duration_s) times.insert(t);
  };
  for (const Track& track : clip.tracks) {
    add(track.translation.time_s);
    add(track.rotation.time_s);
    add(track.scale.time_s);
  }
  return {times.begin(), times.end()};
}

class Retargeter {
 public:
  Retargeter(const Skeleton& source, const Clip& clip, const Skeleton& target)
      : source_(source),
        clip_(clip),
        target_(target),
        match_(match_joints(source, target)),
        source_rest_(rest_frames(source)),
        target_rest_(rest_frames(target)),
        track_of_(target.joints.size()) {}

  engine::Result<RetargetedClip> run() {
    if (match_.count < kFewestMatched || match_.source_hips == kNoIndex || match_.target_hips == kNoIndex)
      return engine::Error{
          engine::ErrorCode::kInvalidArgument,
          "The clip '" + clip_.name + "' cannot be carried over: its skeleton shares " +
              std::to_string(match_.count) + " joint names with the target" +
              (match_.count < kFewestMatched ? "." : ", but no hips."),
          "Rename the joints as a common convention does (hips, thigh, calf, upperarm, ...)."};
    plan_ = plan_alignment(source_rest_, target_, target_rest_, match_);
    out_.clip.name = clip_.name;
    out_.clip.duration_s = clip_.duration_s;
    const std::vector<double> times = key_times(clip_);
    if (plan_.ground_unknown) plan_.source_hips_at_rest.y() += lowest_joint_of_clip(times);
    for (const double time : times) add_pose(time);
    for (Track& track : track_of_)
      if (!track.rotation.empty()) out_.clip.tracks.push_back(std::move(track));
    report();
    return std::move(out_);
  }

 private:
  /// The height of the lowest joint of any key. Where the rest pose does not show the ground, the clip does:
  /// a foot that stands has its joint as far above the floor as the target has its own.
  double lowest_joint_of_clip(const std::vector<double>& times) const {
    std::vector<Affine> world(source_.joints.size());
    double low_m = std::numeric_limits<double>::infinity();
    for (const double time : times) {
      joint_matrices(source_, clip_, time, world);
      for (const Affine& map : world) low_m = std::min(low_m, map(1, 3));
    }
    return low_m;
  }

  void add_pose(double time) {
    source_local_.resize(source_.joints.size());
    sample(source_, clip_, time, source_local_);
    const std::vector<Quaterniond> turned = world_rotations(source_, source_local_);
    std::vector<Quaterniond> world(target_.joints.size());
    for (std::size_t j = 0; j < target_.joints.size(); ++j) {
      const std::int32_t parent = target_.joints[j].parent;
      const Quaterniond above =
          parent < 0 ? Quaterniond::Identity() : world[static_cast<std::size_t>(parent)];
      const std::size_t from = match_.source_of[j];
      if (from == kNoIndex) {
        world[j] = above * target_.joints[j].local.rotation.normalized();
        continue;
      }
      const Quaterniond moved = turned[from] * source_rest_.rotation[from].conjugate();
      world[j] = plan_.facing * moved * plan_.facing.conjugate() * plan_.align[j] * target_rest_.rotation[j];
      add_rotation(j, time, (above.conjugate() * world[j]).normalized());
    }
    add_hips(time);
  }

  /// Takes the sign that lies nearer to the key before.
  void add_rotation(std::size_t joint, double time, Quaterniond rotation) {
    Track& track = track_of_[joint];
    track.joint = static_cast<std::uint16_t>(joint);
    if (!track.rotation.empty() && track.rotation.value.back().dot(rotation) < 0.0)
      rotation.coeffs() = -rotation.coeffs();
    track.rotation.time_s.push_back(time);
    track.rotation.value.push_back(rotation);
  }

  /// What moves above the hips counts, so the target is posed with the rotations found for this time.
  void add_hips(double time) {
    std::vector<Affine> world(std::max(source_.joints.size(), target_.joints.size()));
    world_matrices(source_, source_local_, world);
    const Vec3 moved = world[match_.source_hips].col(3) - plan_.source_hips_at_rest;
    const Vec3 hips = target_rest_.position[match_.target_hips] + plan_.root_scale * (plan_.facing * moved);
    std::vector<LocalTransform> local(target_.joints.size());
    for (std::size_t j = 0; j < local.size(); ++j) {
      local[j] = target_.joints[j].local;
      if (!track_of_[j].rotation.empty()) local[j].rotation = track_of_[j].rotation.value.back();
    }
    world_matrices(target_, local, world);
    const std::int32_t parent = target_.joints[match_.target_hips].parent;
    Track& track = track_of_[match_.target_hips];
    track.translation.time_s.push_back(time);
    track.translation.value.push_back(
        parent < 0 ? hips : apply(inverse(world[static_cast<std::size_t>(parent)]), hips));
  }

  void report() {
    std::vector<bool> used(source_.joints.size());
    for (std::size_t j = 0; j < target_.joints.size(); ++j) {
      const std::size_t from = match_.source_of[j];
      (from == kNoIndex ? out_.report.unmatched_target : out_.report.matched)
          .push_back(target_.joints[j].name);
      if (from != kNoIndex) used[from] = true;
    }
    for (const Track& track : clip_.tracks)
      if (!used[track.joint]) out_.report.unmatched_source.push_back(source_.joints[track.joint].name);
    out_.report.root_scale = plan_.root_scale;
  }

  const Skeleton& source_;
  const Clip& clip_;
  const Skeleton& target_;
  const JointMatch match_;
  const RestFrames source_rest_, target_rest_;
  Alignment plan_;
  std::vector<LocalTransform> source_local_;
  std::vector<Track> track_of_;  // of each joint of the target
  RetargetedClip out_;
};

}  // namespace

engine::Result<RetargetedClip> retarget(const Skeleton& source, const Clip& clip, const Skeleton& target) {
  if (auto checked = validate(source); !checked) return checked.error();
  if (auto checked = validate(clip, source); !checked) return checked.error();
  if (auto checked = validate(target); !checked) return checked.error();
  return Retargeter(source, clip, target).run();
}

}  // namespace bodice::rig
