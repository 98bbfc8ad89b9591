#include <algorithm>
#include <cmath>

#include <bodice/rigging/motion.hpp>

#include "motion/motions.hpp"
#include "posture/pose.hpp"

namespace bodice::inline v0_1::rigging {
namespace {

/// Keys a second: between two of them a planted foot strays less than a tenth of a millimeter.
constexpr double kKeysPerSecond = 60.0;

struct Entry {
  Posture (*posture)(double phase, const Build& build);
  double duration_s;
};

Entry entry(Motion motion) {
  switch (motion) {
    case Motion::kWalk:
      return {walk, 1.1};
    case Motion::kRun:
      return {run, 0.7};
    case Motion::kTurn:
      return {turn, 4.0};
    case Motion::kSpin:
      return {spin, 1.0};
    case Motion::kReach:
      return {reach, 4.0};
    case Motion::kSit:
      return {sit, 3.0};
    case Motion::kSquat:
      return {squat, 3.0};
    case Motion::kArmsUp:
      return {arms_up, 3.0};
    case Motion::kDance:
      return {dance, 4.0};
  }
  return {walk, 1.1};
}

double stride(Motion motion) {
  if (motion == Motion::kWalk) return walking_stride();
  if (motion == Motion::kRun) return running_stride();
  return 0.0;
}

Build build_of(const Figure& figure) {
  return {.hip_half_width = figure.hip_half_width,
          .thigh = 0.5 * (figure.leg[0].thigh + figure.leg[1].thigh) / figure.leg_m,
          .calf = 0.5 * (figure.leg[0].calf + figure.leg[1].calf) / figure.leg_m};
}

std::vector<Posture> postures(const Entry& entry, const Figure& figure, int intervals,
                              const MotionOptions& options) {
  std::vector<Posture> all;
  const Build build = build_of(figure);
  for (int k = 0; k <= intervals; ++k) {
    all.push_back(entry.posture(static_cast<double>(k) / intervals, build));
    for (ArmPosture& arm : all.back().arm) arm.raise += options.arms_out_deg;
  }
  return all;
}

std::vector<JointPose> solve(const Figure& figure, const std::vector<Posture>& postures) {
  double lower = 0.0;  // one for all keys: a correction of each key alone would make the hips jerk
  for (const Posture& posture : postures) lower = std::max(lower, missing_reach(figure, posture));
  std::vector<JointPose> poses;
  for (const Posture& posture : postures) poses.push_back(pose_joints(figure, posture, lower));
  return poses;
}

rig::Track track_of(const Figure& figure, body::JointId id, const std::vector<double>& time_s,
                    const std::vector<JointPose>& poses) {
  rig::Track track;
  track.joint = static_cast<std::uint16_t>(figure.index(id));
  track.rotation.time_s = time_s;
  for (const JointPose& pose : poses) {
    Eigen::Quaterniond q = pose.rotation[static_cast<int>(id)];
    if (!track.rotation.value.empty() && q.dot(track.rotation.value.back()) < 0.0) q.coeffs() = -q.coeffs();
    track.rotation.value.push_back(q);
  }
  if (id != body::JointId::kPelvis) return track;
  track.translation.time_s = time_s;
  for (const JointPose& pose : poses) track.translation.value.push_back(pose.pelvis);
  return track;
}

}  // namespace

engine::Result<rig::Clip> make_clip(const rig::Skeleton& skeleton, Motion motion,
                                    const MotionOptions& options) {
  auto figure = measure(skeleton);
  if (!figure) return figure.error();
  if (options.floor_m) figure->origin.y() = *options.floor_m;
  const Entry wanted = entry(motion);
  const int intervals = static_cast<int>(std::lround(wanted.duration_s * kKeysPerSecond));
  std::vector<JointPose> poses = solve(*figure, postures(wanted, *figure, intervals, options));
  rig::Clip clip;
  clip.name = name(motion);
  clip.duration_s = wanted.duration_s;
  std::vector<double> time_s;
  for (int k = 0; k <= intervals; ++k) {
    const double phase = static_cast<double>(k) / intervals;
    time_s.push_back(wanted.duration_s * phase);
    if (options.travel)
      poses[k].pelvis += figure->heading * Vec3(0.0, 0.0, stride(motion) * figure->leg_m * phase);
  }
  for (int i = 0; i < body::kJointCount; ++i)
    if (figure->joint[i] >= 0)
      clip.tracks.push_back(track_of(*figure, static_cast<body::JointId>(i), time_s, poses));
  std::sort(clip.tracks.begin(), clip.tracks.end(),
            [](const rig::Track& a, const rig::Track& b) { return a.joint < b.joint; });
  return clip;
}

engine::Result<double> travel_speed_mps(const rig::Skeleton& skeleton, Motion motion) {
  const auto figure = measure(skeleton);
  if (!figure) return figure.error();
  return stride(motion) * figure->leg_m / entry(motion).duration_s;
}

}  // namespace bodice::rigging
