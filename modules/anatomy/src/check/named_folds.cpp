#include "check/named_folds.hpp"

#include <algorithm>

namespace bodice::inline v0_1::anatomy {
namespace {

/// Confidence of a fold in doubt.
constexpr double kFoldInDoubt = 0.3;

}  // namespace

bool in_doubt(const Anatomy& anatomy, const NamedFold& fold) {
  return std::ranges::any_of(anatomy.warnings, [&](const engine::Warning& w) {
    return w.code == fold.code && w.part == body::name(fold.part);
  });
}

void doubt_fold(const NamedFold& fold, const std::string& lies, const std::string& shown_by,
                Anatomy& anatomy) {
  double& confidence = anatomy.landmarks[static_cast<std::size_t>(fold.id)].confidence;
  confidence = std::min(confidence, kFoldInDoubt);
  const std::string name(fold.name);
  anatomy.warnings.push_back({fold.code, std::string(body::name(fold.part)),
                              "The" + name.substr(3) + " lies " + lies,
                              "Check this border in the result; a pose with arms and legs apart" + shown_by});
}

}  // namespace bodice::anatomy
