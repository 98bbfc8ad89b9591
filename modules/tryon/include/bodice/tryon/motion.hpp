// A moving body: its rig, which plays a clip, and points that are attached to its skin.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/rig/rig.hpp>

namespace bodice::inline v0_1::tryon {

/// The motion of a body: a rig with weights for each vertex of its skin, and the clip that it plays.
struct BodyMotion {
  rig::Rig rig;
  rig::Clip clip;
  double arms_out_deg = 0.0;  ///< rigging::MotionOptions::arms_out_deg of a made motion, else 0
};

/// Checks that the rig and its clip are valid, and that the rig has weights for this number of vertices.
/// Fails with kUnusableGeometry or kInvalidArgument, and names the joint, key or number that is wrong. O(#V +
/// #J + #keys).
engine::Result<void> check(const BodyMotion& motion, std::size_t vertices);

/// Joints over time: a ramp from the bind pose, in which garments are put on, to the clip's first frame, and
/// then the clip. Times are seconds of the clip. The ramp has negative times and ends at 0, with the
/// velocities that the clip has there. After its end the clip starts over if `playback` loops; otherwise its
/// last pose holds.
class MotionPlayer {
 public:
  /// `ramp_s` is the length of the ramp; zero jumps. Keeps a reference to `motion`. Allocates.
  MotionPlayer(const BodyMotion& motion, double ramp_s, rig::Playback playback = rig::Playback::kClamp);

  /// The length of the ramp, seconds.
  double ramp_s() const noexcept { return ramp_s_; }
  /// World matrix of each joint (joint space to world, #J) at a time. Allocates nothing.
  void joints(double time_s, std::span<rig::Affine> world);

 private:
  const BodyMotion* motion_;
  double ramp_s_;
  rig::Playback playback_;
  std::vector<rig::LocalTransform> bind_, local_, ahead_;  // #J; the last two are scratch
};

/// The length of a ramp to the clip's first frame on which no vertex is faster than a walking hand, seconds.
/// It is between a quarter of a second and two, and zero if the clip begins in the bind pose. O(#V).
double suggested_ramp_s(const engine::Context& context, const BodyMotion& motion,
                        std::span<const geometry::Vec3> skin);

/// The motion with a clip that can loop. Where the clip's end is not its start, a seam of at most two seconds
/// leads back (rig::close_loop()). On it no vertex is much faster than at the clip's ends, or than a walking
/// hand. O(#V).
BodyMotion closed_loop(const engine::Context& context, const BodyMotion& motion,
                       std::span<const geometry::Vec3> skin);

/// Skin weights of points that move with the skin: those of the closest point of the skin, interpolated in
/// its triangle. Points and skin (`distance` is of `mesh`) are in the bind pose. Cost: a closest point each.
rig::SkinWeights attach_to_skin(const geometry::TriMesh& mesh, const geometry::MeshDistance& distance,
                                const rig::SkinWeights& skin_weights, std::span<const geometry::Vec3> points);

}  // namespace bodice::tryon
