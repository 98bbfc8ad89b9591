#include "analyze/folds_to_wall.hpp"

#include <algorithm>

namespace bodice::inline v0_1::anatomy {
namespace {

using body::LandmarkId;
using geometry::Vec3;

/// An armpit is the same on skin and copy within this distance, in statures, as a deep copy moves it.
constexpr double kSameArmpit = 0.025;
/// The largest share of a raised arm that points down.
constexpr double kRaised = 0.5;

Vec3 mark_of(const Anatomy& found, LandmarkId id) {
  return found.landmarks[static_cast<std::size_t>(id)].position;
}

}  // namespace

std::vector<Fold> folds_to_wall(std::vector<Fold> folds, const std::vector<Web>& seen, const Anatomy& rough,
                                const Anatomy& as_is) {
  std::erase_if(folds, [&](const Fold& fold) {
    if (fold.id == LandmarkId::kPerineum) return false;
    const LandmarkId elbow = fold.id == LandmarkId::kArmpitL ? LandmarkId::kElbowL : LandmarkId::kElbowR;
    const Vec3 armpit = mark_of(rough, fold.id), arm = mark_of(rough, elbow) - armpit;
    const bool raised = arm.dot(rough.up) > -kRaised * arm.norm();
    const bool same = (armpit - mark_of(as_is, fold.id)).norm() < kSameArmpit * rough.stature_m;
    return raised && same && std::ranges::find(seen, fold.id, &Web::id) == seen.end();
  });
  return folds;
}

}  // namespace bodice::anatomy
