#include "check/cross_check_positions.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "skin/centerline.hpp"

namespace bodice::anatomy {
namespace {

using geodesic::Field;
using geometry::Index;

/// Where an end's second way looks for it, around the first answer; of the size.
constexpr float kNearEnd = 0.08F, kNearCrown = 0.20F;
/// A limb that bends less has no bend to read; its joint is then told by proportion. A bend alone contradicts
/// nothing: on heavy arms it may be flesh at the wrist or a raised shoulder.
constexpr float kBent_rad = 0.6F;
/// Where joints may lie: of fingertip to armpit, and of toe to perineum, along the skin.
constexpr float kElbowFrom = 0.40F, kElbowTo = 0.85F, kKneeFrom = 0.38F, kKneeTo = 0.92F;
/// Where they lie on a straight limb, on the mean of made and scanned bodies.
constexpr float kElbowShare = 0.635F, kKneeShare = 0.61F;

/// Of the vertices within `radius` of the first answer, the farthest from the perineum.
double end_apart(const Skin& skin, const BodyCoordinates& coordinates, const Field& from_end,
                 const geometry::Vec3& first, float radius) {
  const Field& from_perineum = coordinates.from_perineum();
  Index best = geometry::kNoIndex;
  for (std::size_t v = 0; v < from_end.size(); ++v)
    if (from_end[v] <= radius && (best == geometry::kNoIndex || from_perineum[v] > from_perineum[best]))
      best = static_cast<Index>(v);
  if (best == geometry::kNoIndex) return -1.0;
  return (skin.mesh.positions[best] - first).norm() / static_cast<double>(coordinates.size_m());
}

struct Limb {
  const Field& from_end;
  float length;  ///< from its end to where it leaves the trunk, meters
  float from, to, share;
};

double joint_apart(const Skin& skin, const BodyCoordinates& coordinates, const Limb& limb,
                   const Girth& first) {
  if (first.vertex == geometry::kNoIndex || !(limb.length > 0.0F)) return -1.0;
  const Bend bend = sharpest_bend(skin, limb.from_end, limb.from * limb.length, limb.to * limb.length);
  float apart = std::abs(limb.share * limb.length - first.level_m);
  if (bend.angle_rad > kBent_rad) apart = std::min(apart, std::abs(bend.level - first.level_m));
  return static_cast<double>(apart / coordinates.size_m());
}

}  // namespace

void cross_check_positions(const engine::Context& context, const Skin& skin,
                           const BodyCoordinates& coordinates, const Landmarks& marks, CrossCheck& second) {
  const BodyExtremities& tips = coordinates.extremities();
  const float size = coordinates.size_m();
  const auto& p = skin.mesh.positions;
  constexpr std::size_t kTasks = 4;  // hands and feet of both sides
  engine::parallel_for(context, kTasks, 1, [&](std::size_t task, std::size_t) {
    const int side = static_cast<int>(task % 2);
    const bool arm = task < 2;
    const Field& field = arm ? *tips.from_hand[side] : *tips.from_foot[side];
    const Index end = arm ? tips.hand[side] : tips.foot[side];
    (arm ? second.fingertip : second.toe)[side] =
        end_apart(skin, coordinates, field, p[end], kNearEnd * size);
    const Limb limb = arm ? Limb{field, field[marks.armpit[side]], kElbowFrom, kElbowTo, kElbowShare}
                          : Limb{field, field[marks.perineum], kKneeFrom, kKneeTo, kKneeShare};
    (arm ? second.elbow : second.knee)[side] =
        joint_apart(skin, coordinates, limb, arm ? marks.elbow[side] : marks.knee[side]);
  });
  second.crown = end_apart(skin, coordinates, *tips.from_head, marks.crown_place, kNearCrown * size);
}

}  // namespace bodice::anatomy
