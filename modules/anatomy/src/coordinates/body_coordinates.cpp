#include "coordinates/body_coordinates.hpp"

#include <cmath>

#include <coefficients/perineum.hpp>

#include <bodice/engine/parallel.hpp>

#include "coordinates/shoulder_level.hpp"
#include "coordinates/signature.hpp"
#include "skin/nearest_signature.hpp"
#include "skin/soft_position.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using geodesic::Field;
using geometry::Index;

/// The signature of the perineum. Its features, in the order of perineum_features():
/// 1. the distances from both feet together, over twice the path from a foot to where the legs merge;
/// 2. the difference of the distances from the feet;
/// 3. the difference of the distances from the hands, which is made zero at the crown;
/// 4. the distance from the front;
/// 5. the distance from the back;
/// 6. how far the point lies behind the merge of the legs;
/// 7. the distances from both hands together;
/// 8. the distance from the head;
/// 9. the detour of the path from head to feet through the point.
/// They are expected by four measures of the body: distances between the feet and between the hands, and
/// distances of the merge from front and back.
constexpr Signature<9, 4> kPerineum = make_signature<9, 4>(
    coefficients::perineum::kMean, coefficients::perineum::kOfBody, coefficients::perineum::kWhiten);

/// The path from head to feet plus that from foot to foot along the skin, as a multiple of the stature. With
/// the pose one grows as the other shrinks.
constexpr float kSizeToStature = 2.19F;
/// The range in which the perineum lies on the path from one foot to the other, as shares of that path.
constexpr float kPerineumFrom = 0.45F, kPerineumTo = 0.58F;
/// The usual distances from breastbone and back to where the legs merge, for legs on which that is not found;
/// fractions of the body size.
constexpr float kUsualMergeFront = 0.34F, kUsualMergeBack = 0.39F;
/// The usual level at which the loop around an arm widens, as a share of the path from fingertip to
/// fingertip, for arms on which it does not.
constexpr float kUsualShoulder = 0.425F;

/// The vertex in the middle between two extremities, for skins on which the midline cannot be traced.
SkinPoint middle_of_path(const Skin& skin, const Field& from, Index to) {
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

BodyCoordinates::BodyCoordinates(const engine::Context& context, const Skin& skin,
                                 const BodyExtremities& tips)
    : tips_(tips) {
  measure_lengths();
  constexpr std::size_t kTasks = 4;  // the midline, the merge of the legs, two shoulders
  engine::parallel_for(context, kTasks, 1, [&](std::size_t task, std::size_t) {
    if (task == 0) find_middle(skin);
    if (task == 1) merge_ = find_leg_merge(skin, tips);
    if (task >= 2) shoulder_[task - 2] = shoulder_level(skin, *tips.from_hand[task - 2], tips.hands_apart);
  });
  engine::parallel_for(context, 2, 1, [&](std::size_t i, std::size_t) {
    (i == 0 ? from_front_ : from_back_) = distances_from(skin, i == 0 ? midline_.front : midline_.back);
  });
  find_perineum(context, skin);
  from_perineum_ = geodesic::distances_from(skin.graph, perineum_);
  trunk_ = from_perineum_[tips.head];
}

void BodyCoordinates::find_middle(const Skin& skin) {
  midline_ = find_midline(skin, tips_);
  midline_found_ = midline_.front.found() && midline_.back.found();
  if (!midline_.front.found()) midline_.front = middle_of_path(skin, *tips_.from_hand[0], tips_.hand[1]);
  if (!midline_.back.found()) midline_.back = midline_.front;
}

void BodyCoordinates::measure_lengths() {
  size_ = (tips_.head_to_feet + tips_.feet_apart) / kSizeToStature;
  for (int side = 0; side < 2; ++side) {
    head_to_hand_[side] = (*tips_.from_head)[tips_.hand[side]];
    head_to_foot_[side] = (*tips_.from_head)[tips_.foot[side]];
    hand_to_foot_[side] = (*tips_.from_hand[side])[tips_.foot[side]];
  }
}

void BodyCoordinates::find_perineum(const engine::Context& context, const Skin& skin) {
  const bool merged = merge_.at.found();
  const std::size_t count = tips_.from_foot[0]->size();
  merge_front_ = merged ? value_at(skin, merge_.at, from_front_) : kUsualMergeFront * size_;
  merge_back_ = merged ? value_at(skin, merge_.at, from_back_) : kUsualMergeBack * size_;
  const auto expected = kPerineum.expected(perineum_measures());
  const auto distance2 = [&](std::size_t v) { return kPerineum.distance2(perineum_features(v), expected); };
  const auto may_be = [&](std::size_t v) { return may_be_perineum(v); };
  const NearestSignature best = nearest_signature(context, count, may_be, distance2);
  const auto before_it = [&](std::size_t v) {
    return may_be(v) && from_front_[v] < from_front_[best.vertex] - kInFront * size_;
  };
  const NearestSignature front = nearest_signature(context, count, before_it, distance2);
  if (before_it(front.vertex)) perineum_margin_ = front.mahalanobis - best.mahalanobis;
  const NearestSignature found = perineum_margin_ < kFoldMargin ? front : best;
  const float least2 = found.mahalanobis * found.mahalanobis;
  perineum_position_ =
      soft_position(skin, found.vertex, kSoftRadius * static_cast<double>(size_),
                    [&](Index v) { return may_be(v) ? std::exp(-0.5F * (distance2(v) - least2)) : 0.0F; });
  perineum_ = vertex_near(skin, perineum_position_, found.vertex);
  perineum_mahalanobis_ = found.mahalanobis;
}

bool BodyCoordinates::may_be_perineum(std::size_t v) const {
  const float feet = (*tips_.from_foot[0])[v] + (*tips_.from_foot[1])[v];
  return feet > 2.0F * kPerineumFrom * tips_.feet_apart && feet < 2.0F * kPerineumTo * tips_.feet_apart;
}

std::array<float, 9> BodyCoordinates::perineum_features(std::size_t v) const {
  const Field &left_hand = *tips_.from_hand[0], &right_hand = *tips_.from_hand[1], &head = *tips_.from_head;
  const Field &left_foot = *tips_.from_foot[0], &right_foot = *tips_.from_foot[1];
  const float tilt = left_hand[tips_.head] - right_hand[tips_.head];
  const float half_path = merge_.at.found() ? merge_.distance : 0.5F * tips_.feet_apart;
  return {
      (left_foot[v] + right_foot[v]) / (2.0F * half_path),
      (left_foot[v] - right_foot[v]) / tips_.feet_apart,
      (left_hand[v] - right_hand[v] - tilt) / tips_.hands_apart,
      from_front_[v] / size_,
      from_back_[v] / size_,
      0.5F * (merge_back_ - merge_front_ - from_back_[v] + from_front_[v]) / size_,
      0.5F * (left_hand[v] + right_hand[v]) / tips_.hands_apart,
      head[v] / size_,
      0.5F * ((head[v] + left_foot[v]) / head_to_foot_[0] + (head[v] + right_foot[v]) / head_to_foot_[1])};
}

std::array<float, 4> BodyCoordinates::perineum_measures() const {
  return {tips_.feet_apart / size_, tips_.hands_apart / size_, merge_front_ / size_, merge_back_ / size_};
}

bool BodyCoordinates::on_head(std::size_t v) const {
  return (*tips_.from_head)[v] < kHeadReach * size_ && kNeck(at(v, 0)) > 0.0F;
}

CoordinateArray BodyCoordinates::at(std::size_t v, int side) const {
  const float head = (*tips_.from_head)[v];
  const std::array<float, 2> hand{(*tips_.from_hand[0])[v], (*tips_.from_hand[1])[v]};
  const std::array<float, 2> foot{(*tips_.from_foot[0])[v], (*tips_.from_foot[1])[v]};
  const float shoulder = shoulder_[side] > 0.0F ? shoulder_[side] : kUsualShoulder * tips_.hands_apart;
  CoordinateArray x{};
  x[kFromHead] = head / size_;
  x[kOwnHand] = hand[side] / tips_.hands_apart;
  x[kOtherHand] = hand[1 - side] / tips_.hands_apart;
  x[kOwnFoot] = foot[side] / tips_.feet_apart;
  x[kOtherFoot] = foot[1 - side] / tips_.feet_apart;
  x[kFromFront] = from_front_[v] / size_;
  x[kFromBack] = from_back_[v] / size_;
  x[kFromPerineum] = from_perineum_[v] / trunk_;
  x[kHandFootDetour] = (hand[side] + foot[side]) / hand_to_foot_[side];
  x[kHeadHandDetour] = 0.5F * ((head + hand[0]) / head_to_hand_[0] + (head + hand[1]) / head_to_hand_[1]);
  x[kHeadFootDetour] = 0.5F * ((head + foot[0]) / head_to_foot_[0] + (head + foot[1]) / head_to_foot_[1]);
  x[kPastShoulder] = (hand[side] - shoulder) / tips_.hands_apart;
  return x;
}

}  // namespace bodice::anatomy
