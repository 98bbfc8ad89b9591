#include "analyze/folds_hidden.hpp"

#include "check/named_folds.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using geometry::Vec3;

/// A web hides an armpit or the crotch if that is higher on the thin copy by this fraction of the stature.
/// Without webs the difference is 0.003.
constexpr double kHidden = 0.01;

}  // namespace

std::string hidden_folds(const Anatomy& as_is, const Anatomy& apart) {
  std::string text;
  for (const NamedFold& fold : kNamedFolds) {
    const auto at = static_cast<std::size_t>(fold.id);
    const Vec3 offset = apart.landmarks[at].position - as_is.landmarks[at].position;
    if (offset.dot(apart.up) < kHidden * apart.stature_m) continue;
    text += (text.empty() ? "" : ", ") + std::string(fold.name);
  }
  return text;
}

}  // namespace bodice::anatomy
