#include "check/fold_doubts.hpp"

#include <algorithm>
#include <array>
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

/// Webs at both armpits of such a skin look unlike folds, by the least product of the three confidences, and
/// lie too low alike: on average by the first share of what is doubtful, and neither by less than the second.
constexpr double kWebsFit = 0.6, kBothHidden = 0.95, kEitherHidden = 0.6;

/// The confidence of a neck below which it is in doubt where limbs were cut: a web may reach the shoulder.
constexpr double kNeckSeen = 0.75;

const body::Landmark& landmark_of(const Anatomy& anatomy, body::LandmarkId id) {
  return anatomy.landmarks[static_cast<std::size_t>(id)];
}

/// Whether webs may hide both armpits of a skin that is as it was given.
bool hides_armpits(const Anatomy& anatomy, const std::array<double, 3>& below) {
  double fit = 1.0;
  for (const NamedFold& fold : kNamedFolds) fit *= landmark_of(anatomy, fold.id).confidence;
  const double mean = 0.5 * (below[0] + below[1]), least = std::min(below[0], below[1]);
  return fit < kWebsFit && mean > kBothHidden * kArmpitOff && least > kEitherHidden * kArmpitOff;
}

void doubt_neck(Anatomy& anatomy) {
  if (landmark_of(anatomy, body::LandmarkId::kNeck).confidence >= kNeckSeen) return;
  doubt_fold({body::LandmarkId::kNeck, body::Part::kHead, "neck-uncertain", "the neck"},
             "where limbs were cut off skin that has grown together, and looks unlike known ones.",
             ", seen from all sides, shows it.", anatomy);
}

}  // namespace

bool was_cut(const Anatomy& anatomy) {
  return std::ranges::any_of(anatomy.warnings,
                             [](const engine::Warning& w) { return w.code == "limbs-cut"; });
}

bool was_closed(const Options& options) {
  return std::ranges::any_of(options.made_up, [](std::uint8_t made_up) { return made_up != 0; });
}

bool may_hide_folds(const Options& options, const Anatomy& anatomy) {
  const auto below = folds_below_expected(anatomy.landmarks);
  return below && (was_closed(options) || hides_armpits(anatomy, *below));
}

void doubt_folds(const Options& options, Anatomy& anatomy) {
  const bool cut = was_cut(anatomy);
  if (cut) doubt_neck(anatomy);
  const auto below = folds_below_expected(anatomy.landmarks);
  if (!below) return;
  const bool hidden = hides_armpits(anatomy, *below);
  for (std::size_t i = 0; i < kNamedFolds.size(); ++i) {
    const NamedFold& fold = kNamedFolds[i];
    const bool crotch = fold.id == body::LandmarkId::kPerineum;
    const double off = (*below)[i];
    // Skin that closes a hole may have a fold too low, and none too high.
    const bool as_given = !cut && (off < 0.0 || !was_closed(options));
    if (as_given && crotch) continue;
    const double armpit_room = as_given && !hidden ? kAsGiven : 1.0;
    const double confidence = landmark_of(anatomy, fold.id).confidence;
    const double crotch_room = !cut && confidence >= kLooksRight ? kCrotchRoom : 1.0;
    const double most = crotch ? crotch_room * kPerineumOff : armpit_room * kArmpitOff;
    if (std::abs(off) <= most) continue;
    doubt_fold(fold,
               std::to_string(std::lround(1e3 * std::abs(off))) + " thousandths of the stature " +
                   (off > 0.0 ? "lower" : "higher") + " than limbs and trunk predict.",
               ", seen from all sides, shows it.", anatomy);
  }
}

}  // namespace bodice::anatomy
