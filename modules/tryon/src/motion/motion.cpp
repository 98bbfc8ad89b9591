#include <bodice/tryon/motion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <bodice/engine/message.hpp>
#include <bodice/engine/parallel.hpp>
#include <bodice/rig/loop.hpp>

#include "motion/local_pose.hpp"

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Vec3;

constexpr double kRampSpeed_m_s = 1.0;  // the speed of a hand in a walk
constexpr double kShortestRamp_s = 0.25, kLongestRamp_s = 2.0;
// The farthest vertex distance of two poses that need no ramp or seam between them.
constexpr double kAtRest_m = 1e-4;
constexpr double kShortestSeam_s = 1.0 / 60.0;
constexpr std::size_t kPointGrain = 1024;

double farthest_m(const engine::Context& context, std::span<const Vec3> a, std::span<const Vec3> b) {
  return engine::ordered_reduce(
      context, a.size(), kPointGrain, 0.0,
      [&](std::size_t begin, std::size_t end) {
        double most = 0.0;
        for (std::size_t i = begin; i < end; ++i) most = std::max(most, (a[i] - b[i]).norm());
        return most;
      },
      [](double x, double y) { return std::max(x, y); });
}

/// Barycentric weights of a point in the plane of a triangle; a triangle without area gives equal ones.
std::array<double, 3> barycentric(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& point) {
  const Vec3 normal = (b - a).cross(c - a);
  const double twice_area = normal.squaredNorm();
  if (!(twice_area > 0.0)) return {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};
  const double v = std::clamp((point - a).cross(c - a).dot(normal) / twice_area, 0.0, 1.0);
  const double w = std::clamp((b - a).cross(point - a).dot(normal) / twice_area, 0.0, 1.0 - v);
  return {1.0 - v - w, v, w};
}

/// A skin in the poses of a motion.
class PosedSkin {
 public:
  PosedSkin(const engine::Context& context, const BodyMotion& motion, std::span<const Vec3> skin)
      : context_(context),
        motion_(motion),
        skin_(skin),
        world_(motion.rig.skeleton.joints.size()),
        skinning_(world_.size()) {}

  std::vector<Vec3> at(double time_s) {
    rig::joint_matrices(motion_.rig.skeleton, motion_.clip, time_s, world_);
    rig::skinning_matrices(motion_.rig.skeleton, world_, skinning_);
    std::vector<Vec3> posed(skin_.size());
    rig::skin_linear(context_, skin_, motion_.rig.weights, skinning_, posed);
    return posed;
  }

 private:
  const engine::Context& context_;
  const BodyMotion& motion_;
  std::span<const Vec3> skin_;
  std::vector<rig::Affine> world_, skinning_;  // #J
};

}  // namespace

engine::Result<void> check(const BodyMotion& motion, std::size_t vertices) {
  if (auto good = rig::validate(motion.rig.skeleton); !good) return good;
  if (auto good = rig::validate(motion.clip, motion.rig.skeleton); !good) return good;
  if (motion.rig.weights.vertices() != vertices)
    return engine::Error{engine::ErrorCode::kInvalidArgument,
                         engine::message("The rig has skin weights for ", motion.rig.weights.vertices(),
                                         " vertices, but the skin has ", vertices, "."),
                         "Give the rig that was read or made with this skin."};
  return {};
}

MotionPlayer::MotionPlayer(const BodyMotion& motion, double ramp_s, rig::Playback playback)
    : motion_(&motion),
      ramp_s_(std::isfinite(ramp_s) ? std::max(0.0, ramp_s) : 0.0),
      playback_(playback),
      bind_(local_bind_pose(motion.rig.skeleton)),
      local_(bind_.size()),
      ahead_(bind_.size()) {}

void MotionPlayer::joints(double time_s, std::span<rig::Affine> world) {
  const double left_s = ramp_s_ > 0.0 ? std::clamp(-time_s, 0.0, ramp_s_) : 0.0;
  sample_with_ramp(*motion_, std::max(0.0, time_s), playback_, {bind_, ramp_s_, left_s}, local_, ahead_);
  rig::world_matrices(motion_->rig.skeleton, local_, world);
}

double suggested_ramp_s(const engine::Context& context, const BodyMotion& motion,
                        std::span<const Vec3> skin) {
  const double far_m = farthest_m(context, skin, PosedSkin(context, motion, skin).at(0.0));
  if (far_m < kAtRest_m) return 0.0;
  return std::clamp(far_m / kRampSpeed_m_s, kShortestRamp_s, kLongestRamp_s);
}

BodyMotion closed_loop(const engine::Context& context, const BodyMotion& motion, std::span<const Vec3> skin) {
  const double end_s = motion.clip.duration_s, step_s = std::min(kShortestSeam_s, end_s);
  if (!(end_s > 0.0)) return motion;
  PosedSkin posed(context, motion, skin);
  const std::vector<Vec3> start = posed.at(0.0), end = posed.at(end_s);
  const double far_m = farthest_m(context, start, end);
  if (far_m < kAtRest_m) return motion;
  const double moved_m = std::max(farthest_m(context, start, posed.at(step_s)),
                                  farthest_m(context, end, posed.at(end_s - step_s)));
  const double speed_m_s = std::max(kRampSpeed_m_s, moved_m / step_s);
  BodyMotion closed = motion;
  closed.clip = rig::close_loop(motion.clip, std::clamp(far_m / speed_m_s, kShortestSeam_s, kLongestRamp_s));
  return closed;
}

rig::SkinWeights attach_to_skin(const geometry::TriMesh& mesh, const geometry::MeshDistance& distance,
                                const rig::SkinWeights& skin_weights, std::span<const Vec3> points) {
  rig::SkinWeights weights;
  weights.first.push_back(0);
  std::map<std::uint16_t, double> of_joint;
  for (const Vec3& point : points) {
    of_joint.clear();
    const geometry::SurfacePoint nearest = distance.closest_point(point);
    const geometry::Triangle& corners = mesh.triangles[nearest.triangle];
    const std::array<double, 3> share = barycentric(mesh.positions[corners[0]], mesh.positions[corners[1]],
                                                    mesh.positions[corners[2]], nearest.point);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::uint32_t e = skin_weights.first[corners[k]]; e < skin_weights.first[corners[k] + 1]; ++e)
        of_joint[skin_weights.joint[e]] += share[k] * double{skin_weights.weight[e]};
    for (const auto& [joint, weight] : of_joint) {
      if (!(weight > 0.0)) continue;
      weights.joint.push_back(joint);
      weights.weight.push_back(static_cast<float>(weight));
    }
    weights.first.push_back(static_cast<std::uint32_t>(weights.joint.size()));
  }
  return weights;
}

}  // namespace bodice::tryon
