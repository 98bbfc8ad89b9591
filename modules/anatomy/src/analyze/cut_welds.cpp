#include "analyze/cut_welds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>

#include <bodice/anatomy/plausible.hpp>

#include "analyze/expected_folds.hpp"
#include "analyze/folds_hidden.hpp"
#include "analyze/folds_look.hpp"
#include "analyze/folds_to_wall.hpp"
#include "analyze/thin_copy.hpp"
#include "analyze/tips_of_skin.hpp"
#include "analyze/weld_signs.hpp"
#include "check/fold_doubts.hpp"
#include "check/fold_levels.hpp"
#include "check/named_folds.hpp"
#include "walls/webs.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using body::LandmarkId;
using geometry::MeshDistance;
using geometry::TriMesh;
using geometry::Vec3;

/// The depths of thin copies, fractions of the stature: 2, 9 and 14 mm. The first keeps most fingers, by
/// which arms are measured, and suffices where limbs are joined by webs alone. Where limbs are not apart at
/// one depth, they may be at the next.
constexpr std::array kDepths = {0.0012, 0.0053, 0.0082};
/// The shares of the limbs' depth that a neck between limbs may have, where walls are needed.
constexpr std::array kNecks = {0.92, 0.95, 0.88};
/// The number of depths that are tried with walls, which need no deep copy.
constexpr std::size_t kWalledDepths = 2;
/// The largest ratio of a body's area to its squared length. Bodies have 0.55 to 0.85, a heavy one 0.9.
constexpr double kMostArea = 1.0;

/// The most passes over one copy; each cuts the webs that the one before revealed.
constexpr int kPasses = 3;
/// How often folds are moved to their predicted positions; each time the prediction is more accurate.
constexpr int kMostMoves = 2;
/// The largest distance of a landmark below the fold up to which limbs were cut, in statures.
constexpr double kBelowFold = 0.025;

/// The folds of a copy kMuchDeeper times as deep as the first lie too high: less than usual is doubtful.
constexpr double kMuchDeeper = 2.0, kDeepMisfit = 0.6;

/// A body with welded limbs, and the means to analyze it.
struct WeldedBody {
  const engine::Context& context;
  const TriMesh& mesh;
  const MeshDistance& distance;
  SampledSkin& skin;
  const Options& options;
  Analyze analyze;
};

/// Adds the warning "limbs-cut". If `sure`, it is a note without a remedy, and so are warnings of handles,
/// which then come from walls with gaps.
void warn(const std::string& where, const ThinCopy& thin, bool sure, Anatomy& apart) {
  std::erase_if(apart.warnings, [](const engine::Warning& w) { return w.code == "holes"; });
  for (engine::Warning& w : apart.warnings) w.note = w.note || (sure && w.code == "limbs-fused");
  apart.warnings.push_back(
      {"limbs-cut", "",
       "Parts of the body are welded to each other" + (where.empty() ? "" : " at " + where) +
           "; they were cut apart " + std::to_string(std::lround(1e3 * thin.depth / apart.stature_m)) +
           " thousandths of the stature below the skin.",
       sure ? "" : "Check the borders of parts there; a pose with arms and legs apart needs no cut.", sure});
}

/// Whether nothing but a handle is in doubt, and armpits and crotch are where the limbs predict them, or are
/// plausible. With `webs_only` the room inside the body gave the folds, which is evidence as well.
bool is_sure(const Anatomy& apart, const ThinCopy& thin, bool webs_only) {
  const bool deep = thin.depth > kDepths[0] * kMuchDeeper * apart.stature_m;
  if (doubts_but_handles(apart) > 0 || fold_misfit(apart.landmarks) > (deep ? kDeepMisfit : 1.0))
    return false;
  if (folds_below_expected(apart.landmarks) || (webs_only && doubts(apart) == 0)) return true;
  return !deep && looks_right(apart);
}

/// A thin copy on which limbs are apart, and the result on it.
struct SeparatedCopy {
  ThinCopy thin;
  Anatomy found;
  std::vector<Web> left;  ///< webs that are left after the cuts
};

/// Analyzes a copy with its present walls. Empty if limbs are not apart on it, or it is no human body.
std::optional<SeparatedCopy> analyze_copy(const WeldedBody& body, double depth) {
  auto thin = body.skin.thin_copy(body.context, depth);
  if (!thin) return std::nullopt;
  auto found = body.analyze(body.context, thin->mesh, body.options);
  if (!found || limbs_meet(*found) || !contradictions(thin->mesh, *found).empty()) return std::nullopt;
  std::vector<Web> left = find_webs(body.context, thin->mesh, *found);
  return SeparatedCopy{std::move(*thin), std::move(*found), std::move(left)};
}

/// Adds webs as folds, which replace earlier folds of the same landmarks.
void add_folds(const std::vector<Web>& webs, std::vector<Fold>& folds) {
  for (const Web& web : webs) {
    std::erase_if(folds, [&](const Fold& fold) { return fold.id == web.id; });
    folds.push_back({web.id, web.fold, (web.fold - web.edge).normalized()});
  }
}

bool is_cut(LandmarkId armpit, const std::vector<Fold>& folds) {
  return armpit != LandmarkId::kPerineum && std::ranges::find(folds, armpit, &Fold::id) != folds.end();
}

int count_doubts(const SeparatedCopy& copy) {
  return doubts(copy.found) + static_cast<int>(copy.left.size());
}

/// Whether landmarks lie at the folds. They lie lower where a wall has a gap.
bool reaches(const Anatomy& found, const std::vector<Fold>& folds) {
  return std::ranges::all_of(folds, [&](const Fold& fold) {
    const Vec3& mark = found.landmarks[static_cast<std::size_t>(fold.id)].position;
    return (fold.at - mark).dot(fold.inward) < kBelowFold * found.stature_m;
  });
}

/// Cuts limbs apart that are known roughly. A web may hide another web, so that each cut is followed by
/// another analysis, as long as the number of doubts falls.
std::optional<SeparatedCopy> separate_known(const WeldedBody& body, const Anatomy& rough,
                                            std::vector<Fold> folds) {
  std::optional<SeparatedCopy> best;
  for (int pass = 1; pass <= kPasses; ++pass) {
    body.skin.wall_known_limbs(body.context, body.distance, best ? best->found : rough, folds);
    auto copy = analyze_copy(body, kDepths.front());
    // An arm beside a wall seems to have a web in any case.
    if (copy) std::erase_if(copy->left, [&](const Web& web) { return is_cut(web.id, folds); });
    if (!copy || !reaches(copy->found, folds) || (best && count_doubts(*copy) >= count_doubts(*best)))
      return best;
    best = std::move(copy);
    if (best->left.empty()) return best;
    add_folds(best->left, folds);
  }
  return best;
}

/// Warns of landmarks that webs have displaced, and lowers their confidence.
void doubt(const std::vector<Web>& webs, Anatomy& anatomy) {
  for (const Web& web : webs)
    doubt_fold(*std::ranges::find(kNamedFolds, web.id, &NamedFold::id),
               "lower than the room inside the body shows: skin that has grown together hides it.",
               " has none.", anatomy);
}

/// Transfers the result on a copy to the skin, with warnings.
Anatomy transferred(const WeldedBody& body, const SeparatedCopy& copy, const engine::Result<Anatomy>& as_is,
                    bool webs_only) {
  Anatomy apart = carry_out(body.context, copy.thin, copy.found, body.mesh);
  const std::string where = as_is ? hidden_folds(*as_is, apart) : "";
  doubt(copy.left, apart);
  if (as_is) take_tips(*as_is, apart);
  if (as_is) apart.stages = as_is->stages;
  warn(where, copy.thin, is_sure(apart, copy.thin, webs_only), apart);
  return apart;
}

/// Refines the result on a deep copy, which has no fingers and too high folds, by a shallow copy with walls.
/// Walls at armpits that need none are left out where limbs are apart without.
Anatomy refined(const WeldedBody& body, Anatomy rough, const std::vector<Web>& seen,
                const engine::Result<Anatomy>& as_is) {
  std::vector<Fold> folds = find_folds(body.context, body.mesh, rough);
  std::vector<Web> armpits = seen;
  std::erase_if(armpits, [](const Web& web) { return web.id == LandmarkId::kPerineum; });
  add_folds(armpits, folds);
  std::vector<Fold> few = as_is ? folds_to_wall(folds, seen, rough, *as_is) : folds;
  std::optional<SeparatedCopy> copy;
  if (few.size() < folds.size()) copy = separate_known(body, rough, std::move(few));
  if (!copy || count_doubts(*copy) > 0) copy = separate_known(body, rough, std::move(folds));
  if (!copy) return rough;
  Anatomy fine = transferred(body, *copy, as_is, false);
  return doubts_but_handles(fine) > doubts_but_handles(rough) ? rough : fine;
}

/// Moves folds that do not fit limbs and trunk to the predicted positions, and cuts limbs apart up to these.
/// Keeps the better result.
Anatomy with_predicted_folds(const WeldedBody& body, Anatomy apart, const engine::Result<Anatomy>& as_is,
                             bool webs_only) {
  for (int pass = 1; pass <= kMostMoves; ++pass) {
    std::vector<Fold> folds = expected_folds(body.context, body.mesh, apart);
    if (folds.empty()) return apart;
    const auto copy = separate_known(body, apart, std::move(folds));
    if (!copy) return apart;
    Anatomy next = transferred(body, *copy, as_is, webs_only);
    if (doubts(next) > doubts(apart) || fold_misfit(next.landmarks) >= fold_misfit(apart.landmarks))
      return apart;
    apart = std::move(next);
  }
  return apart;
}

/// The most doubts of a result with limbs apart that is better than the one on the skin as it is. Each web
/// and each path that is too short counts as a doubt of the latter: without them, one handle at the fingers
/// would be worse.
int most_doubts(const Anatomy& as_is, const std::vector<Web>& seen) {
  return doubts(as_is) + short_paths(as_is) + static_cast<int>(seen.size());
}

/// The result on a copy of this depth; empty if it has more doubts than the result on the skin itself.
std::optional<Anatomy> apart_at_depth(const WeldedBody& body, double depth, const std::vector<Web>& seen,
                                      const engine::Result<Anatomy>& as_is) {
  const auto copy = analyze_copy(body, depth);
  if (!copy || shows_welds(copy->found)) return std::nullopt;
  const Anatomy first = refined(body, transferred(body, *copy, as_is, false), seen, as_is);
  Anatomy apart = with_predicted_folds(body, first, as_is, false);
  if (as_is && doubts(apart) > most_doubts(*as_is, seen)) return std::nullopt;
  doubt_moved_folds(body.context, body.mesh, first, apart);
  return apart;
}

std::optional<Anatomy> webs_apart(const WeldedBody& body, const std::vector<Web>& seen,
                                  const engine::Result<Anatomy>& as_is) {
  std::vector<Fold> folds;
  add_folds(seen, folds);
  const auto copy = separate_known(body, *as_is, std::move(folds));
  if (!copy) return std::nullopt;
  const Anatomy first = transferred(body, *copy, as_is, true);
  Anatomy apart = with_predicted_folds(body, first, as_is, true);
  if (doubts(apart) > most_doubts(*as_is, seen)) return std::nullopt;
  doubt_moved_folds(body.context, body.mesh, first, apart);
  return apart;
}

/// Whether the skin has too much area for its length, because it has two bodies or a floor.
bool has_too_much_area(const TriMesh& mesh) {
  const double length = geometry::bounding_box(mesh.positions).size().maxCoeff();
  return geometry::surface_area(mesh) > kMostArea * length * length;
}

/// Keeps the result with armpits and crotch nearest to their predicted positions, if it has no more doubts.
/// Returns whether they are as near as on whole bodies.
bool keep_better(std::optional<Anatomy> apart, std::optional<Anatomy>& best) {
  if (!apart) return false;
  const double off = fold_misfit(apart->landmarks);
  const bool sound = !best || doubts(*apart) <= doubts(*best);
  const bool fits = sound && off <= 1.0;
  if (!best || (sound && off < fold_misfit(best->landmarks))) best = std::move(apart);
  return fits;
}

std::optional<Anatomy> welds_apart(const WeldedBody& body, const std::vector<Web>& seen,
                                   const engine::Result<Anatomy>& as_is, bool welded) {
  std::optional<Anatomy> best;
  for (const double depth : std::span(kDepths).subspan(1)) {
    body.skin.remove_walls();
    if (keep_better(apart_at_depth(body, depth, seen, as_is), best)) return best;
  }
  if (!welded || has_too_much_area(body.mesh)) return best;
  for (const double neck : std::span(kNecks).first(best ? 1 : kNecks.size()))
    for (const double depth : std::span(kDepths).first(kWalledDepths)) {
      body.skin.wall_limbs(body.context, body.distance, neck);
      if (keep_better(apart_at_depth(body, depth, seen, as_is), best)) return best;
    }
  return best;
}

}  // namespace

engine::Result<Anatomy> cut_welds(const engine::Context& context, const TriMesh& mesh, const Options& options,
                                  Analyze analyze) {
  auto as_is = analyze(context, mesh, options);
  const std::vector<Web> seen =
      as_is ? find_webs(context, mesh, *as_is, options.made_up) : std::vector<Web>{};
  const bool welded = is_welded(as_is) || arms_differ(as_is), by_level = !welded && seen.empty();
  const std::vector<Web> webs = by_level ? webs_by_level(context, mesh, options, *as_is) : seen;
  if (!welded && webs.empty()) return as_is;
  const MeshDistance distance(context, mesh);
  if (auto skin = SampledSkin::make(mesh, distance)) {
    const WeldedBody body{context, mesh, distance, *skin, options, analyze};
    auto apart = welded ? std::nullopt : webs_apart(body, webs, as_is);
    const bool as_given = by_level && !was_closed(options);
    const auto is_better = [&] {
      return apart && (!as_given || outweighs_skin(*apart, *as_is)) &&
             fold_misfit(apart->landmarks) < fold_misfit(as_is->landmarks);
    };
    if (by_level ? !is_better() : !apart) apart = welds_apart(body, webs, as_is, welded || by_level);
    if (by_level && !is_better()) return as_is;
    if (as_given) doubt_moved_folds(context, mesh, *as_is, *apart);
    if (apart) return std::move(*apart);
  }
  if (as_is) doubt(seen, *as_is);
  return as_is;
}

}  // namespace bodice::anatomy
