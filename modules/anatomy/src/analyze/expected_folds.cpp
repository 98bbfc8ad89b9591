#include "analyze/expected_folds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "analyze/low_armpits.hpp"
#include "check/fold_doubts.hpp"
#include "check/fold_levels.hpp"
#include "check/named_folds.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

/// A fold with an error above this multiple of the doubtful one stays in doubt after it was moved. In scans
/// with moved folds, nine that were right then had 1.0 to 1.44, and two that were still wrong 1.6 and 1.8.
constexpr double kFarOff = 1.5;

/// How far above an armpit the room inside the body shows its fold, where limbs were cut apart up to it: of
/// the ten armpits of five scans with a moved one, the nine correct ones are in this range, and a wrong one
/// is above.
constexpr double kLeastRoom = -0.03, kMostRoom = -0.012;

double doubtful(body::LandmarkId id) {
  return id == body::LandmarkId::kPerineum ? kPerineumOff : kArmpitOff;
}

bool confirmed_by_room(const engine::Context& context, const geometry::TriMesh& skin, const Anatomy& found) {
  return std::ranges::all_of(kNamedFolds, [&](const NamedFold& fold) {
    if (fold.id == body::LandmarkId::kPerineum) return true;
    const auto room = web_height(context, skin, found, fold.id);
    return room && *room > kLeastRoom && *room < kMostRoom;
  });
}

}  // namespace

std::vector<Fold> expected_folds(const engine::Context& context, const geometry::TriMesh& skin,
                                 const Anatomy& found) {
  const auto below = folds_below_expected(found.landmarks);
  if (!below) return {};
  const std::array<double, 2> low = armpits_too_low(context, skin, found);
  if (fold_misfit(found.landmarks) <= 1.0 && std::ranges::max(low) <= 0.0) return {};
  std::vector<Fold> folds = find_folds(context, skin, found);
  for (std::size_t i = 0; i < kNamedFolds.size(); ++i) {
    const body::LandmarkId id = kNamedFolds[i].id;
    const bool far = std::abs((*below)[i]) > doubtful(id), up = i < low.size() && low[i] > 0.0;
    if (!far && !up) continue;
    Fold moved = fold_at(found, id);
    moved.at += (far ? (*below)[i] : low[i]) * found.stature_m * moved.inward;
    *std::ranges::find(folds, id, &Fold::id) = moved;
  }
  return folds;
}

void doubt_moved_folds(const engine::Context& context, const geometry::TriMesh& skin, const Anatomy& before,
                       Anatomy& after) {
  const auto was = folds_below_expected(before.landmarks), is = folds_below_expected(after.landmarks);
  if (!was || !is) return;
  for (std::size_t i = 0; i < kNamedFolds.size(); ++i) {
    const double most = doubtful(kNamedFolds[i].id);
    if (std::abs((*was)[i]) <= kFarOff * most || std::abs((*is)[i]) > most) continue;
    if (kNamedFolds[i].id != body::LandmarkId::kPerineum && confirmed_by_room(context, skin, after)) continue;
    doubt_fold(kNamedFolds[i],
               "where limbs and trunk predict it, and was found " +
                   std::to_string(std::lround(1e3 * std::abs((*was)[i]))) +
                   " thousandths of the stature off.",
               ", seen from all sides, shows it.", after);
  }
}

std::vector<Web> webs_by_level(const engine::Context& context, const geometry::TriMesh& skin,
                               const Options& options, const Anatomy& found) {
  std::vector<Web> webs;
  const auto below = folds_below_expected(found.landmarks);
  if (!below) return webs;
  const bool hidden = may_hide_folds(options, found);
  const std::array<double, 2> low = armpits_too_low(context, skin, found);
  for (std::size_t i = 0; i < kNamedFolds.size(); ++i) {
    const body::LandmarkId id = kNamedFolds[i].id;
    const bool far = hidden && (*below)[i] > doubtful(id);
    const double up = far ? (*below)[i] : i < low.size() ? low[i] : 0.0;
    if (!(up > 0.0)) continue;
    const Fold edge = fold_at(found, id);
    webs.push_back({id, edge.at, edge.at + up * found.stature_m * edge.inward});
  }
  return webs;
}

}  // namespace bodice::anatomy
