#include "analyze/low_armpits.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "check/fold_levels.hpp"
#include "check/named_folds.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

/// The least error by limbs and trunk that counts as evidence, a deviation of whole bodies. With less, the
/// room is not measured.
constexpr double kLeastBelow = 0.01;
/// The largest sum of both kinds of evidence on almost all whole bodies.
constexpr double kTogether = 0.02;
/// How far the room inside a whole body has the fold below its armpit.
constexpr double kRoomBelow = 0.01;
/// The least room above an armpit that is evidence by itself, on a body that was cut apart. Correct armpits
/// have 0.01 at most, and three that walls beside webs had led outward 0.05 to 0.08.
constexpr double kRoomAlone = 0.03;

/// The least sum of both kinds of evidence at the crotch. Whole bodies have -0.016 to 0.04, correct ones
/// among those that were cut -0.024 and more, and one with a wall that went too far up -0.037.
constexpr double kCrotchTogether = -0.031;

/// Doubts the armpit of a side that lies too low by this fraction of the stature, unless it is in doubt
/// already.
void doubt_height(std::size_t side, double low, const std::string& evidence, Anatomy& anatomy) {
  const NamedFold& fold = kNamedFolds[side];
  if (in_doubt(anatomy, fold)) return;
  doubt_fold(
      fold,
      std::to_string(std::lround(1e3 * low)) + " thousandths of the stature lower than " + evidence + ".",
      ", seen from all sides, shows it.", anatomy);
}

}  // namespace

std::array<double, 2> armpits_too_low(const engine::Context& context, const geometry::TriMesh& skin,
                                      const Anatomy& found) {
  std::array<double, 2> up{};
  const auto below = folds_below_expected(found.landmarks);
  if (!below) return up;
  for (std::size_t side = 0; side < up.size(); ++side) {
    const double by_limbs = (*below)[side];
    if (by_limbs < kLeastBelow) continue;
    const auto by_room = web_height(context, skin, found, kNamedFolds[side].id);
    if (by_room && by_limbs + *by_room > kTogether) up[side] = 0.5 * (by_limbs + *by_room + kRoomBelow);
  }
  return up;
}

void doubt_low_armpits(const engine::Context& context, const geometry::TriMesh& skin, Anatomy& anatomy) {
  const std::array<double, 2> up = armpits_too_low(context, skin, anatomy);
  for (std::size_t side = 0; side < up.size(); ++side)
    if (up[side] > 0.0)
      doubt_height(side, up[side], "limbs, trunk and the room inside the body predict", anatomy);
}

void doubt_armpits_by_room(const engine::Context& context, const geometry::TriMesh& skin, Anatomy& anatomy) {
  for (std::size_t side = 0; side < 2; ++side) {
    if (in_doubt(anatomy, kNamedFolds[side])) continue;  // the room takes long to find
    const auto by_room = web_height(context, skin, anatomy, kNamedFolds[side].id);
    if (by_room && *by_room >= kRoomAlone)
      doubt_height(side, *by_room, "the room inside the body shows", anatomy);
  }
}

void doubt_high_crotch(const engine::Context& context, const geometry::TriMesh& skin, Anatomy& anatomy) {
  const NamedFold& crotch = *std::ranges::find(kNamedFolds, body::LandmarkId::kPerineum, &NamedFold::id);
  const auto below = folds_below_expected(anatomy.landmarks);
  if (!below || in_doubt(anatomy, crotch) || (*below)[2] >= 0.0) return;  // the room takes long to find
  const auto by_room = web_height(context, skin, anatomy, crotch.id);
  if (!by_room || (*below)[2] + *by_room >= kCrotchTogether) return;
  doubt_fold(crotch,
             std::to_string(std::lround(-1e3 * ((*below)[2] + *by_room))) +
                 " thousandths of the stature higher than limbs, trunk and the room inside the body predict.",
             ", seen from all sides, shows it.", anatomy);
}

}  // namespace bodice::anatomy
