#include "check/fold_doubts.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "check/fold_levels.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using body::LandmarkId;
using body::Part;

/// Confidence of a landmark in doubt: below that of one that is named in a warning.
constexpr double kFoldInDoubt = 0.3;
/// The skin of a body that was neither cut nor closed speaks for its folds: armpits are in doubt where they
/// are this many times as far off, as webs have them that fill all room beside the trunk, and crotches never.
constexpr double kAsGiven = 1.75;

struct JudgedFold {
  LandmarkId id;
  Part part;
  const char *code, *name;
  double most;
};
constexpr std::array<JudgedFold, 3> kJudgedFolds = {
    {{LandmarkId::kArmpitL, Part::kUpperArmL, "armpit-uncertain", "The left armpit", kArmpitOff},
     {LandmarkId::kArmpitR, Part::kUpperArmR, "armpit-uncertain", "The right armpit", kArmpitOff},
     {LandmarkId::kPerineum, Part::kThighL, "perineum-uncertain", "The crotch", kPerineumOff}}};

bool was_changed(const Options& options, const Anatomy& anatomy) {
  return std::ranges::any_of(options.made_up, [](std::uint8_t made_up) { return made_up != 0; }) ||
         std::ranges::any_of(anatomy.warnings,
                             [](const engine::Warning& w) { return w.code == "limbs-cut"; });
}

}  // namespace

void doubt_folds(const Options& options, Anatomy& anatomy) {
  const auto below = folds_below_expected(anatomy.landmarks);
  if (!below) return;
  const bool changed = was_changed(options, anatomy);
  for (std::size_t i = 0; i < kJudgedFolds.size(); ++i) {
    const JudgedFold& fold = kJudgedFolds[i];
    const double off = (*below)[i];
    if (!changed && fold.id == LandmarkId::kPerineum) continue;
    if (std::abs(off) <= (changed ? 1.0 : kAsGiven) * fold.most) continue;
    double& confidence = anatomy.landmarks[static_cast<std::size_t>(fold.id)].confidence;
    confidence = std::min(confidence, kFoldInDoubt);
    anatomy.warnings.push_back(
        {fold.code, std::string(body::name(fold.part)),
         std::string(fold.name) + " lies " + std::to_string(std::lround(1e3 * std::abs(off))) +
             " thousandths of the stature " + (off > 0.0 ? "lower" : "higher") +
             " than limbs and trunk let expect.",
         "Check this border in the result; a pose with arms and legs apart, seen from all sides, shows it."});
  }
}

}  // namespace bodice::anatomy
