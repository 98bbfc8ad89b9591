// Based on: the paper, section 2.1 (the neck at the least girth of the isolines around the head)
#include "check/cross_check.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "check/cross_check_positions.hpp"
#include "skin/curve.hpp"
#include "skin/girth_profile.hpp"

namespace bodice::anatomy {
namespace {

/// Where the neck may be, from the crown along the skin, of the size; FACTS.md's window, wider for children.
constexpr float kNeckFrom = 0.11F, kNeckTo = 0.40F;
constexpr std::size_t kSteps = 58;

/// The lowest local minimum of girth between a wider head and wider shoulders; 0 if girth only grows.
float narrowest_level(const GirthProfile& profile) {
  const auto& girth = profile.girth_m;
  std::size_t best = 0;
  for (std::size_t i = 1; i + 1 < girth.size(); ++i) {
    const bool dip = girth[i] <= girth[i - 1] && girth[i] <= girth[i + 1] && girth[i] > 0.0F;
    if (dip && (best == 0 || girth[i] < girth[best])) best = i;
  }
  return best == 0 ? 0.0F : profile.level(best);
}

double neck_apart(const Skin& skin, const BodyCoordinates& coordinates, const Landmarks& marks) {
  const geodesic::Field& from_head = *coordinates.extremities().from_head;
  const float size = coordinates.size_m();
  const float level =
      narrowest_level(girth_profile(skin, from_head, kNeckFrom * size, kNeckTo * size, kSteps));
  if (!(level > 0.0F) || marks.neck.vertex == geometry::kNoIndex) return -1.0;
  const auto lines = geodesic::isolines(skin.mesh, skin.edges, from_head, {&level, 1})[0];
  const geodesic::Isoline* loop = widest_closed(lines);
  if (loop == nullptr) return -1.0;
  return (loop->centroid - marks.neck_place).norm() / static_cast<double>(size);
}

double perineum_apart(const Skin& skin, const BodyCoordinates& coordinates) {
  const SkinPoint& merge = coordinates.leg_merge().at;
  if (!merge.found()) return -1.0;
  return static_cast<double>(value_at(skin, merge, coordinates.from_perineum()) / coordinates.size_m());
}

double armpit_apart(const BodyCoordinates& coordinates, const Landmarks& marks, int side) {
  const float level = coordinates.shoulder_level_m(side);
  if (!(level > 0.0F)) return -1.0;
  const float found = (*coordinates.extremities().from_hand[side])[marks.armpit[side]];
  return static_cast<double>(std::abs(found - level) / coordinates.size_m());
}

/// Arms are of one length; a shrug or a twist changes the ways along them by half of what is a contradiction.
double armpits_differ(const BodyCoordinates& coordinates, const Landmarks& marks) {
  const BodyExtremities& tips = coordinates.extremities();
  const float left = (*tips.from_hand[0])[marks.armpit[0]], right = (*tips.from_hand[1])[marks.armpit[1]];
  return static_cast<double>(std::abs(left - right) / coordinates.size_m());
}

}  // namespace

CrossCheck cross_check(const engine::Context& context, const Skin& skin, const BodyCoordinates& coordinates,
                       const Landmarks& marks) {
  CrossCheck second;
  engine::parallel_for(context, 2, 1, [&](std::size_t task, std::size_t) {
    if (task == 0) second.neck = neck_apart(skin, coordinates, marks);
    if (task == 1) second.perineum = perineum_apart(skin, coordinates);
  });
  cross_check_positions(context, skin, coordinates, marks, second);
  for (int side = 0; side < 2; ++side) second.armpit[side] = armpit_apart(coordinates, marks, side);
  second.armpits = armpits_differ(coordinates, marks);
  return second;
}

double checked_confidence(double confidence, double apart, double most) {
  if (!(apart >= 0.0)) return 0.5 * confidence;
  const double off = std::min(1.0, apart / most);
  return confidence * (1.0 - off * off);
}

}  // namespace bodice::anatomy
