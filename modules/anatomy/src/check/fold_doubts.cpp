#include "check/fold_doubts.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "check/fold_levels.hpp"
#include "check/named_folds.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

/// The skin of a body that was neither cut nor closed speaks for its folds: armpits are in doubt where they
/// are this many times as far off, as webs have them that fill all room beside the trunk, and crotches never.
constexpr double kAsGiven = 1.75;

/// The crotch of a skin that was closed, but not cut, may be so many times as far off where it looks right by
/// itself, from this confidence on.
constexpr double kLooksRight = 0.85, kCrotchRoom = 1.5;

bool was_cut(const Anatomy& anatomy) {
  return std::ranges::any_of(anatomy.warnings,
                             [](const engine::Warning& w) { return w.code == "limbs-cut"; });
}

bool was_closed(const Options& options) {
  return std::ranges::any_of(options.made_up, [](std::uint8_t made_up) { return made_up != 0; });
}

}  // namespace

void doubt_folds(const Options& options, Anatomy& anatomy) {
  const auto below = folds_below_expected(anatomy.landmarks);
  if (!below) return;
  const bool cut = was_cut(anatomy), changed = cut || was_closed(options);
  for (std::size_t i = 0; i < kNamedFolds.size(); ++i) {
    const NamedFold& fold = kNamedFolds[i];
    const bool crotch = fold.id == body::LandmarkId::kPerineum;
    const double off = (*below)[i];
    if (!changed && crotch) continue;
    const double confidence = anatomy.landmarks[static_cast<std::size_t>(fold.id)].confidence;
    const double crotch_room = !cut && confidence >= kLooksRight ? kCrotchRoom : 1.0;
    const double most = crotch ? crotch_room * kPerineumOff : (changed ? 1.0 : kAsGiven) * kArmpitOff;
    if (std::abs(off) <= most) continue;
    doubt_fold(fold,
               std::to_string(std::lround(1e3 * std::abs(off))) + " thousandths of the stature " +
                   (off > 0.0 ? "lower" : "higher") + " than limbs and trunk let expect.",
               ", seen from all sides, shows it.", anatomy);
  }
}

}  // namespace bodice::anatomy
