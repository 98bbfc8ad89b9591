#include "motion/moving_thickness.hpp"

#include <span>
#include <utility>
#include <vector>

#include "garment/thickness.hpp"
#include "motion/moving_body.hpp"

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Vec3;

constexpr int kPoses = 12;  // of the clip: the pose at rest is judged besides

}  // namespace

engine::Result<double> moving_thickness_m(const engine::Context& context, const geometry::TriMesh& garment,
                                          const PreparedBody& body, const BodyMotion& motion,
                                          const proxy::BasePoses& bases) {
  auto moving = MovingBody::make(body.skin, body.fit.proxy, true);
  if (!moving) return std::move(moving).error();
  if (auto kept = moving->keep_bases(bases); !kept) return std::move(kept).error();
  const std::vector<Vec3> below = skin_below(context, garment, *body.skin.distance);
  const rig::SkinWeights weights =
      attach_to_skin(body.skin.input.skin, *body.skin.distance, motion.rig.weights, below);
  MotionPlayer player(motion, 0.0);
  std::vector<rig::Affine> joints(motion.rig.skeleton.joints.size());
  std::vector<Vec3> posed(below.size());
  std::vector<float> uncovered_m(garment.positions.size() * kPoses, 0.0f);
  for (int pose = 0; pose < kPoses; ++pose) {
    player.joints(motion.clip.duration_s * pose / (kPoses - 1), joints);
    if (auto taken = moving->pose(context, joints, 0.0); !taken) return std::move(taken).error();
    moving->carry(below, weights, posed);
    find_uncovered(
        context, moving->collider(), posed,
        std::span(uncovered_m).subspan(static_cast<std::size_t>(pose) * below.size(), below.size()));
  }
  return thickness_for(std::move(uncovered_m));
}

}  // namespace bodice::tryon
