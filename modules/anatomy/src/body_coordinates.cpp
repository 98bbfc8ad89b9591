#include "body_coordinates.hpp"

#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "nearest_signature.hpp"

namespace bodice::anatomy {
namespace {

using geodesic::Field;
using geometry::Index;

/// Head to feet plus foot to foot along the skin, of the stature; the two vary against each other with pose.
constexpr float kSizeToStature = 2.19F;
/// The perineum is about half way between the feet.
constexpr float kPerineumFrom = 0.45F, kPerineumTo = 0.58F;

/// The vertex half way between two ends, where the midline cannot be traced.
SkinPoint half_way(const Skin& skin, const Field& from, Index to) {
  SkinPoint best;
  float least = 0.0F;
  const float half = 0.5F * from[to];
  for (std::size_t e = 0; e < skin.edges.ends.size(); ++e) {
    const Index v = skin.edges.ends[e][0];
    const float off = std::abs(from[v] - half);
    if (skin.component[v] != 0 || (best.found() && off >= least)) continue;
    best = {static_cast<Index>(e), skin.mesh.positions[v]};
    least = off;
  }
  return best;
}

}  // namespace

BodyCoordinates::BodyCoordinates(const engine::Context& context, const Skin& skin, const BodyEnds& ends)
    : ends_(ends), midline_(find_midline(skin, ends)) {
  size_ = (ends.head_to_feet + ends.feet_apart) / kSizeToStature;
  midline_found_ = midline_.front.found() && midline_.back.found();
  if (!midline_.front.found()) midline_.front = half_way(skin, *ends.from_hand[0], ends.hand[1]);
  if (!midline_.back.found()) midline_.back = midline_.front;
  engine::parallel_for(context, 2, 1, [&](std::size_t i, std::size_t) {
    (i == 0 ? from_front_ : from_back_) = distances_from(skin, i == 0 ? midline_.front : midline_.back);
  });
  find_perineum(context);
  from_perineum_ = geodesic::distances_from(skin.graph, perineum_);
  trunk_ = from_perineum_[ends.head];
}

void BodyCoordinates::find_perineum(const engine::Context& context) {
  const Field &left_hand = *ends_.from_hand[0], &right_hand = *ends_.from_hand[1];
  const Field &left_foot = *ends_.from_foot[0], &right_foot = *ends_.from_foot[1];
  const float tilt = left_hand[ends_.head] - right_hand[ends_.head];
  const NearestSignature found = nearest_signature(
      context, left_foot.size(),
      [&](std::size_t v) {
        const float feet = left_foot[v] + right_foot[v];
        return feet > 2.0F * kPerineumFrom * ends_.feet_apart && feet < 2.0F * kPerineumTo * ends_.feet_apart;
      },
      [&](std::size_t v) {
        return kPerineum.distance2({(left_foot[v] + right_foot[v]) / ends_.feet_apart,
                                    (left_foot[v] - right_foot[v]) / ends_.feet_apart,
                                    (left_hand[v] - right_hand[v] - tilt) / ends_.hands_apart,
                                    from_front_[v] / size_, from_back_[v] / size_});
      });
  perineum_ = found.vertex;
  perineum_misfit_ = found.misfit;
}

CoordinateArray BodyCoordinates::at(std::size_t v, int side) const {
  return {(*ends_.from_head)[v] / size_,
          (*ends_.from_hand[side])[v] / ends_.hands_apart,
          (*ends_.from_hand[1 - side])[v] / ends_.hands_apart,
          (*ends_.from_foot[side])[v] / ends_.feet_apart,
          (*ends_.from_foot[1 - side])[v] / ends_.feet_apart,
          from_front_[v] / size_,
          from_back_[v] / size_,
          from_perineum_[v] / trunk_};
}

}  // namespace bodice::anatomy
