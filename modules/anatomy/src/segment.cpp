// Borders are isolines of smooth fields of distances along the skin, so they are closed loops that no pose
// frays.
#include "segment.hpp"

#include <cmath>

#include <bodice/engine/parallel.hpp>

namespace bodice::anatomy {
namespace {

using body::Part;
using geometry::Index;

constexpr std::size_t kGrain = 4096;
constexpr float kShoulder = 0.205F;  ///< how much nearer to its own hand a shoulder is, of hand to hand
constexpr float kHip = 1.035F;       ///< of half the way from foot to foot
constexpr float kWaist = 0.44F, kChest = 0.32F;  ///< of the stature, from the crown

Part left_or_right(Part left, int side) {
  return static_cast<Part>(static_cast<int>(left) + side);
}

Part part_of(const BodyEnds& ends, const Landmarks& marks, std::size_t v) {
  const auto stature = static_cast<float>(marks.stature_m);
  const float head = (*ends.from_head)[v];
  if (head < marks.neck.level_m) return Part::kHead;
  const float hand[2] = {(*ends.from_hand[0])[v], (*ends.from_hand[1])[v]};
  const float foot[2] = {(*ends.from_foot[0])[v], (*ends.from_foot[1])[v]};
  const int arm = hand[1] < hand[0], leg = foot[1] < foot[0];
  if (hand[1 - arm] - hand[arm] > kShoulder * ends.hands_apart)
    return left_or_right(hand[arm] < marks.elbow[arm].level_m ? Part::kForearmL : Part::kUpperArmL, arm);
  if (foot[leg] < 0.5F * kHip * ends.feet_apart)
    return left_or_right(foot[leg] < marks.knee[leg].level_m ? Part::kCalfL : Part::kThighL, leg);
  const int side = hand[1] + foot[1] < hand[0] + foot[0];
  if (head < kChest * stature) return left_or_right(Part::kTorsoUL, side);
  return left_or_right(head < kWaist * stature ? Part::kTorsoML : Part::kTorsoLL, side);
}

/// Eyes, teeth, clothes and debris follow the nearest vertex of the body.
void attach_pieces(const engine::Context& context, const Skin& skin, std::vector<Part>& part) {
  if (skin.components < 2) return;
  engine::parallel_for(context, part.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (skin.component[v] == 0) continue;
      double least = std::numeric_limits<double>::infinity();
      std::size_t nearest = v;
      for (std::size_t w = 0; w < part.size(); ++w) {
        if (skin.component[w] != 0) continue;
        const double d = (skin.mesh.positions[w] - skin.mesh.positions[v]).squaredNorm();
        if (d < least) {
          least = d;
          nearest = w;
        }
      }
      part[v] = part[nearest];
    }
  });
}

}  // namespace

std::vector<Part> segment(const engine::Context& context, const Skin& skin, const BodyEnds& ends,
                          const Landmarks& marks) {
  std::vector<Part> part(skin.mesh.positions.size());
  engine::parallel_for(context, part.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      if (skin.component[v] == 0) part[v] = part_of(ends, marks, v);
  });
  attach_pieces(context, skin, part);
  return part;
}

}  // namespace bodice::anatomy
