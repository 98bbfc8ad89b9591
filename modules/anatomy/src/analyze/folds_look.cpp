#include "analyze/folds_look.hpp"

#include <cmath>

#include "analyze/upright_height.hpp"
#include "check/fold_levels.hpp"
#include "check/named_folds.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

/// The least product of the confidences of armpits and crotch that counts as evidence for them. Scans with
/// correct folds have 0.64 or more, and those with a wrong one 0.33 or less.
constexpr double kFoldsFit = 0.6;
/// The folds of a skin that was neither cut nor closed are in doubt where they are off by this multiple of
/// what is doubtful on others (check/fold_doubts).
constexpr double kInDoubt = 1.75;
/// Two statures count as equal if they differ by less than this share.
constexpr double kSameStature = 0.015;

/// How much armpits and crotch look as they do on known bodies: the product of their confidences.
double folds_look(const Anatomy& found) {
  double look = 1.0;
  for (const NamedFold& fold : kNamedFolds)
    look *= found.landmarks[static_cast<std::size_t>(fold.id)].confidence;
  return look;
}

}  // namespace

bool looks_right(const Anatomy& apart) {
  const auto height = upright_height(apart);
  return height && folds_look(apart) >= kFoldsFit && std::abs(apart.stature_m / *height - 1.0) < kSameStature;
}

bool outweighs_skin(const Anatomy& apart, const Anatomy& as_is) {
  if (folds_look(apart) >= kFoldsFit) return true;
  return fold_misfit(as_is.landmarks) > kInDoubt && fold_misfit(apart.landmarks) <= 1.0 &&
         folds_look(apart) >= folds_look(as_is);
}

}  // namespace bodice::anatomy
