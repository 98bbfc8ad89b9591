#include "analyze/cut_welds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>

#include <bodice/anatomy/plausible.hpp>

#include "analyze/crown_of_skin.hpp"
#include "analyze/expected_folds.hpp"
#include "analyze/folds_hidden.hpp"
#include "analyze/thin_copy.hpp"
#include "analyze/weld_signs.hpp"
#include "check/fold_doubts.hpp"
#include "check/fold_levels.hpp"
#include "check/named_folds.hpp"
#include "check/thighs.hpp"
#include "walls/webs.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using body::LandmarkId;
using geometry::MeshDistance;
using geometry::TriMesh;
using geometry::Vec3;

/// The depths of thin copies, fractions of the stature: 2, 9 and 14 mm. The first keeps the fingers, by which
/// arms are measured, and suffices where limbs are joined by webs alone. Where limbs are not apart at one
/// depth, they may be at the next.
constexpr std::array kDepths = {0.0012, 0.0053, 0.0082};
/// The shares of the limbs' depth that a neck between limbs may have, for walls where no depth parts the
/// limbs.
constexpr std::array kNecks = {0.92, 0.95, 0.88};
/// Walls need no deep copy: so many of the depths are tried with them.
constexpr std::size_t kWalledDepths = 2;
/// Area to squared length of a body is below this: .55 to .85, of a heavy one .9.
constexpr double kMostArea = 1.0;

/// The most passes over one copy; each cuts the webs that the one before revealed.
constexpr int kPasses = 3;
/// How often folds are moved to the positions that limbs and trunk predict, which then are more accurate
/// themselves.
constexpr int kSettling = 2;
/// How far a landmark may lie below the fold up to which limbs were parted; of the stature.
constexpr double kBelowFold = 0.025;

/// The folds of a copy kMuchDeeper times as deep as the first lie too high: less than usual is doubtful.
constexpr double kMuchDeeper = 2.0, kDeepMisfit = 0.6;

/// The least product of the confidences of armpits and crotch that counts as evidence for them. Scans with
/// correct folds have 0.64 or more, and those with a wrong one 0.33 or less.
constexpr double kFoldsFit = 0.6;
/// A stature that changes by less than this share is the same one.
constexpr double kSameStature = 0.015;

/// A body with welded limbs, and how it is analyzed.
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

/// Whether armpits and crotch look as they do on known bodies.
bool folds_fit(const Anatomy& apart) {
  double fit = 1.0;
  for (const NamedFold& fold : kNamedFolds)
    fit *= apart.landmarks[static_cast<std::size_t>(fold.id)].confidence;
  return fit >= kFoldsFit;
}

/// Whether the result for a standing body is plausible although its folds cannot be predicted: they look as
/// on known bodies, and the stature is that of the skin without cuts.
bool looks_right(const engine::Result<Anatomy>& as_is, const Anatomy& apart) {
  return as_is && folds_fit(apart) && std::ranges::min(thigh_cosines(apart)) >= kUpright &&
         std::abs(apart.stature_m / as_is->stature_m - 1.0) < kSameStature;
}

/// Whether nothing but a handle is in doubt, and armpits and crotch are where the limbs predict them, or are
/// plausible. With `webs_only` the room inside the body gave the folds, which is evidence as well.
bool is_sure(const engine::Result<Anatomy>& as_is, const Anatomy& apart, const ThinCopy& thin,
             bool webs_only) {
  const bool deep = thin.depth > kDepths[0] * kMuchDeeper * apart.stature_m;
  if (doubts_but_handles(apart) > 0 || fold_misfit(apart.landmarks) > (deep ? kDeepMisfit : 1.0))
    return false;
  if (folds_below_expected(apart.landmarks) || (webs_only && doubts(apart) == 0)) return true;
  return !deep && looks_right(as_is, apart);
}

/// A thin copy on which limbs are apart, and the result on it.
struct Parted {
  ThinCopy thin;
  Anatomy found;
  std::vector<Web> left;  ///< webs that are left after the cuts
};

/// What a copy of the body, walled as it is now, shows when its limbs have come apart.
std::optional<Parted> look(const WeldedBody& body, double depth) {
  auto thin = body.skin.thin_copy(body.context, depth);
  if (!thin) return std::nullopt;
  auto found = body.analyze(body.context, thin->mesh, body.options);
  if (!found || limbs_meet(*found) || !contradictions(thin->mesh, *found).empty()) return std::nullopt;
  std::vector<Web> left = find_webs(body.context, thin->mesh, *found);
  return Parted{std::move(*thin), std::move(*found), std::move(left)};
}

/// Webs become folds, each in place of the one that was there.
void add_folds(const std::vector<Web>& webs, std::vector<Fold>& folds) {
  for (const Web& web : webs) {
    std::erase_if(folds, [&](const Fold& fold) { return fold.id == web.id; });
    folds.push_back({web.id, web.fold, (web.fold - web.edge).normalized()});
  }
}

bool is_cut(LandmarkId armpit, const std::vector<Fold>& folds) {
  return armpit != LandmarkId::kPerineum && std::ranges::find(folds, armpit, &Fold::id) != folds.end();
}

int in_doubt(const Parted& parted) {
  return doubts(parted.found) + static_cast<int>(parted.left.size());
}

/// Whether landmarks lie at the folds: below a wall with a gap they do not.
bool reaches(const Anatomy& found, const std::vector<Fold>& folds) {
  return std::ranges::all_of(folds, [&](const Fold& fold) {
    const Vec3& mark = found.landmarks[static_cast<std::size_t>(fold.id)].position;
    return (fold.at - mark).dot(fold.inward) < kBelowFold * found.stature_m;
  });
}

/// Parts limbs that are known roughly. What a web hides may be one more, so that each cut is followed by
/// another look, as long as that leaves less in doubt.
std::optional<Parted> part_known(const WeldedBody& body, const Anatomy& rough, std::vector<Fold> folds) {
  std::optional<Parted> best;
  for (int pass = 1; pass <= kPasses; ++pass) {
    body.skin.wall_known_limbs(body.context, body.distance, best ? best->found : rough, folds);
    auto parted = look(body, kDepths.front());
    // An arm that a wall runs along shows a web whether there is one or not.
    if (parted) std::erase_if(parted->left, [&](const Web& web) { return is_cut(web.id, folds); });
    if (!parted || !reaches(parted->found, folds) || (best && in_doubt(*parted) >= in_doubt(*best)))
      return best;
    best = std::move(parted);
    if (best->left.empty()) return best;
    add_folds(best->left, folds);
  }
  return best;
}

/// Landmarks that webs lead astray are no longer trusted.
void doubt(const std::vector<Web>& webs, Anatomy& anatomy) {
  for (const Web& web : webs)
    doubt_fold(*std::ranges::find(kNamedFolds, web.id, &NamedFold::id),
               "lower than the room inside the body shows: skin that has grown together hides it.",
               " has none.", anatomy);
}

/// What is found on a copy, carried out to the skin.
Anatomy carried(const WeldedBody& body, const Parted& parted, const engine::Result<Anatomy>& as_is,
                bool webs_only) {
  Anatomy apart = carry_out(body.context, parted.thin, parted.found, body.mesh);
  const std::string where = as_is ? hidden_folds(*as_is, apart) : "";
  doubt(parted.left, apart);
  if (as_is) judge_crown(*as_is, apart);
  if (as_is) apart.stages = as_is->stages;
  warn(where, parted.thin, is_sure(as_is, apart, parted.thin, webs_only), apart);
  return apart;
}

/// A deep copy has lost fingers, and its folds lie too high. Once it shows how the limbs lie, they are parted
/// by walls in a copy that is hardly thinner than the body.
Anatomy refined(const WeldedBody& body, Anatomy rough, const std::vector<Web>& seen,
                const engine::Result<Anatomy>& as_is) {
  std::vector<Fold> folds = find_folds(body.context, body.mesh, rough);
  std::vector<Web> armpits = seen;
  std::erase_if(armpits, [](const Web& web) { return web.id == LandmarkId::kPerineum; });
  add_folds(armpits, folds);
  const auto parted = part_known(body, rough, std::move(folds));
  if (!parted) return rough;
  Anatomy fine = carried(body, *parted, as_is, false);
  return doubts_but_handles(fine) > doubts_but_handles(rough) ? rough : fine;
}

/// Limbs that were parted up to folds which limbs and trunk contradict are parted up to where these let
/// expect them, if that agrees better.
Anatomy settled(const WeldedBody& body, Anatomy apart, const engine::Result<Anatomy>& as_is, bool webs_only) {
  for (int pass = 1; pass <= kSettling; ++pass) {
    std::vector<Fold> folds = expected_folds(body.context, body.mesh, apart);
    if (folds.empty()) return apart;
    const auto parted = part_known(body, apart, std::move(folds));
    if (!parted) return apart;
    Anatomy next = carried(body, *parted, as_is, webs_only);
    if (doubts(next) > doubts(apart) || fold_misfit(next.landmarks) >= fold_misfit(apart.landmarks))
      return apart;
    apart = std::move(next);
  }
  return apart;
}

/// What a copy of this depth shows, where that leaves no more in doubt than the skin as it is.
std::optional<Anatomy> apart_at(const WeldedBody& body, double depth, const std::vector<Web>& seen,
                                const engine::Result<Anatomy>& as_is) {
  const auto parted = look(body, depth);
  if (!parted || shows_welds(parted->found)) return std::nullopt;
  const Anatomy first = refined(body, carried(body, *parted, as_is, false), seen, as_is);
  Anatomy apart = settled(body, first, as_is, false);
  if (as_is && doubts(apart) > doubts(*as_is) + static_cast<int>(seen.size())) return std::nullopt;
  doubt_moved_folds(first, apart);
  return apart;
}

std::optional<Anatomy> webs_apart(const WeldedBody& body, const std::vector<Web>& seen,
                                  const engine::Result<Anatomy>& as_is) {
  std::vector<Fold> folds;
  add_folds(seen, folds);
  const auto parted = part_known(body, *as_is, std::move(folds));
  if (!parted) return std::nullopt;
  const Anatomy first = carried(body, *parted, as_is, true);
  Anatomy apart = settled(body, first, as_is, true);
  if (doubts(apart) > doubts(*as_is) + static_cast<int>(seen.size())) return std::nullopt;
  doubt_moved_folds(first, apart);
  return apart;
}

/// A skin with so much area for its length is that of two bodies, or has a floor in it.
bool is_of_two(const TriMesh& mesh) {
  const double length = geometry::bounding_box(mesh.positions).size().maxCoeff();
  return geometry::surface_area(mesh) > kMostArea * length * length;
}

/// Keeps the cut with armpits and crotch nearest to where the limbs let expect them, and no more in doubt.
/// Returns whether it has them where whole bodies have.
bool keep_better(std::optional<Anatomy> apart, std::optional<Anatomy>& best) {
  if (!apart) return false;
  const double off = fold_misfit(apart->landmarks);
  const bool sound = !best || doubts(*apart) <= doubts(*best);
  const bool fits = sound && off <= 1.0;
  if (!best || (sound && off < fold_misfit(best->landmarks))) best = std::move(apart);
  return fits;
}

std::optional<Anatomy> welds_apart(const WeldedBody& body, const std::vector<Web>& seen,
                                   const engine::Result<Anatomy>& as_is) {
  std::optional<Anatomy> best;
  for (const double depth : std::span(kDepths).subspan(1)) {
    body.skin.remove_walls();
    if (keep_better(apart_at(body, depth, seen, as_is), best)) return best;
  }
  if (!is_welded(as_is) || is_of_two(body.mesh)) return best;
  for (const double neck : std::span(kNecks).first(best ? 1 : kNecks.size()))
    for (const double depth : std::span(kDepths).first(kWalledDepths)) {
      body.skin.wall_limbs(body.context, body.distance, neck);
      if (keep_better(apart_at(body, depth, seen, as_is), best)) return best;
    }
  return best;
}

}  // namespace

engine::Result<Anatomy> cut_welds(const engine::Context& context, const TriMesh& mesh, const Options& options,
                                  Analyze analyze) {
  auto as_is = analyze(context, mesh, options);
  const std::vector<Web> seen =
      as_is ? find_webs(context, mesh, *as_is, options.made_up) : std::vector<Web>{};
  const bool welded = is_welded(as_is), by_level = !welded && seen.empty();
  const std::vector<Web> webs = by_level ? webs_by_level(context, mesh, options, *as_is) : seen;
  if (!welded && webs.empty()) return as_is;
  const MeshDistance distance(context, mesh);
  if (auto skin = SampledSkin::make(mesh, distance)) {
    const WeldedBody body{context, mesh, distance, *skin, options, analyze};
    auto apart = welded ? std::nullopt : webs_apart(body, webs, as_is);
    const bool as_given = by_level && !was_closed(options);
    if (by_level && !(apart && fold_misfit(apart->landmarks) < fold_misfit(as_is->landmarks))) return as_is;
    if (as_given && !folds_fit(*apart)) return as_is;
    if (as_given) doubt_moved_folds(*as_is, *apart);
    if (!apart) apart = welds_apart(body, seen, as_is);
    if (apart) return std::move(*apart);
  }
  if (as_is) doubt(seen, *as_is);
  return as_is;
}

}  // namespace bodice::anatomy
