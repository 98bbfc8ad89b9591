#include "analyze/cut_welds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>

#include <bodice/anatomy/plausible.hpp>

#include "analyze/thin_copy.hpp"
#include "analyze/webs.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using body::LandmarkId;
using geometry::MeshDistance;
using geometry::TriMesh;
using geometry::Vec3;

/// Depths of thin copies, of the stature: 2, 9 and 14 mm. The first keeps the fingers, by which arms are
/// measured, and serves where webs are all there is; what one does not part, the next may.
constexpr std::array kDepths = {0.0012, 0.0053, 0.0082};
/// Where no depth parts the limbs, walls through necks of these shares of the limbs' depths may.
constexpr std::array kNecks = {0.92, 0.95, 0.88};
/// Walls need no deep copy: so many of the depths are tried with them.
constexpr std::size_t kWalledDepths = 2;
/// Area to squared length of a body is below this: .55 to .85, of a heavy one .9.
constexpr double kMostArea = 1.0;
/// A web hides an armpit or the crotch where the thin copy has it higher by this much of the stature; without
/// webs it is .003.
constexpr double kHidden = 0.01;

/// Looks at a copy, each with the webs cut that the one before showed.
constexpr int kPasses = 3;
/// Confidence of a landmark that a web hides: below that of one that is named in a warning.
constexpr double kInDoubt = 0.3;

/// A body with welded limbs, and how it is analyzed.
struct WeldedBody {
  const engine::Context& context;
  SampledSkin& skin;
  const Options& options;
  Analyze analyze;
};

bool shows_weld(const engine::Warning& w) {
  return w.code == "limbs-fused" || w.code == "hand-fused-to-leg" || w.code == "legs-fused";
}

bool is_welded(const engine::Result<Anatomy>& found) {
  return !found || std::any_of(found->warnings.begin(), found->warnings.end(), shows_weld);
}

int doubts(const Anatomy& anatomy) {
  return static_cast<int>(
      std::count_if(anatomy.warnings.begin(), anatomy.warnings.end(), [](const engine::Warning& w) {
        return w.code.ends_with("-uncertain") || w.code.ends_with("-disagrees") ||
               w.code.ends_with("-differ") || w.code == "unusual-body";
      }));
}

struct Fold {
  LandmarkId id;
  const char* name;
};
constexpr std::array<Fold, 3> kFolds = {{{LandmarkId::kArmpitL, "the left armpit"},
                                         {LandmarkId::kArmpitR, "the right armpit"},
                                         {LandmarkId::kPerineum, "the crotch"}}};

/// The folds that a thin copy shows, joined to a clause; empty if there are none.
std::string folds(const Anatomy& as_is, const Anatomy& apart) {
  std::string text;
  for (const Fold& fold : kFolds) {
    const auto at = static_cast<std::size_t>(fold.id);
    const Vec3 offset = apart.landmarks[at].position - as_is.landmarks[at].position;
    if (offset.dot(apart.up) < kHidden * apart.stature_m) continue;
    text += (text.empty() ? "" : ", ") + std::string(fold.name);
  }
  return text;
}

void warn(const std::string& where, const ThinCopy& thin, Anatomy& apart) {
  std::erase_if(apart.warnings, [](const engine::Warning& w) { return w.code == "holes"; });
  apart.warnings.push_back(
      {"limbs-cut", "",
       "Parts of the body are welded to each other" + (where.empty() ? "" : " at " + where) +
           "; they were cut apart " + std::to_string(std::lround(1e3 * thin.depth / apart.stature_m)) +
           " thousandths of the stature below the skin.",
       "Check the borders of parts there; a pose with arms and legs apart needs no cut."});
}

/// A thin copy that has come apart, and what was found on it.
struct Parted {
  ThinCopy thin;
  Anatomy found;
  std::vector<Web> left;  ///< webs that no cut undid
};

/// What a web hides may be one more, so that each cut is followed by another look.
std::optional<Parted> part(const WeldedBody& body, double depth, std::vector<Web> webs) {
  std::optional<Parted> best;
  const bool walled = body.skin.has_walls();
  for (int pass = 1; pass <= kPasses; ++pass) {
    auto thin = body.skin.thin_copy(body.context, depth, webs);
    if (!thin) return best;
    auto found = body.analyze(body.context, thin->mesh, body.options);
    if (!found) return best;
    std::vector<Web> more = find_webs(body.context, thin->mesh, *found);
    const bool good = !is_welded(found) && contradictions(thin->mesh, *found).empty();
    if (!good && (best || walled)) return best;
    webs.insert(webs.end(), more.begin(), more.end());
    const bool last = more.empty();
    if (good) best = Parted{std::move(*thin), std::move(*found), std::move(more)};
    if (last) return best;
  }
  return best;
}

/// Landmarks that webs lead astray are no longer trusted.
void doubt(const std::vector<Web>& webs, Anatomy& anatomy) {
  for (const Web& web : webs) {
    body::Landmark& mark = anatomy.landmarks[static_cast<std::size_t>(web.id)];
    mark.confidence = std::min(mark.confidence, kInDoubt);
    const bool crotch = web.id == LandmarkId::kPerineum;
    const auto part = crotch                           ? body::Part::kThighL
                      : web.id == LandmarkId::kArmpitL ? body::Part::kUpperArmL
                                                       : body::Part::kUpperArmR;
    anatomy.warnings.push_back(
        {crotch ? "perineum-uncertain" : "armpit-uncertain", std::string(body::name(part)),
         std::string(crotch ? "The crotch" : "This armpit") +
             " lies lower than the room inside the body shows: skin that has grown together hides it.",
         "Check this border in the result; a pose with arms and legs apart has none."});
  }
}

/// What is found on a thin copy, carried out to the skin, where that leaves no more in doubt than the skin as
/// it is.
std::optional<Anatomy> apart_at(const WeldedBody& body, double depth, const TriMesh& mesh,
                                const std::vector<Web>& seen, const engine::Result<Anatomy>& as_is) {
  const auto parted = part(body, depth, seen);
  if (!parted) return std::nullopt;
  Anatomy apart = carry_out(body.context, parted->thin, parted->found, mesh);
  const std::string where = as_is ? folds(*as_is, apart) : "";
  doubt(parted->left, apart);
  if (as_is && doubts(apart) > doubts(*as_is) + static_cast<int>(seen.size())) return std::nullopt;
  if (as_is) apart.stages = as_is->stages;
  warn(where, parted->thin, apart);
  return apart;
}

/// A skin with so much area for its length is that of two bodies, or has a floor in it.
bool is_of_two(const TriMesh& mesh) {
  const double length = geometry::bounding_box(mesh.positions).size().maxCoeff();
  return geometry::surface_area(mesh) > kMostArea * length * length;
}

}  // namespace

engine::Result<Anatomy> cut_welds(const engine::Context& context, const TriMesh& mesh, const Options& options,
                                  Analyze analyze) {
  auto as_is = analyze(context, mesh, options);
  const std::vector<Web> seen = as_is ? find_webs(context, mesh, *as_is) : std::vector<Web>{};
  const bool welded = is_welded(as_is);
  if (!welded && seen.empty()) return as_is;
  const MeshDistance distance(context, mesh);
  if (auto skin = SampledSkin::make(mesh, distance)) {
    const WeldedBody body{context, *skin, options, analyze};
    for (const double depth : std::span(kDepths).subspan(welded ? 1 : 0))
      if (auto apart = apart_at(body, depth, mesh, seen, as_is)) return std::move(*apart);
    for (const double neck : kNecks) {
      if (!welded || is_of_two(mesh)) break;
      skin->wall_limbs(context, distance, neck);
      for (const double depth : std::span(kDepths).first(kWalledDepths))
        if (auto apart = apart_at(body, depth, mesh, seen, as_is)) return std::move(*apart);
    }
  }
  if (as_is) doubt(seen, *as_is);
  return as_is;
}

}  // namespace bodice::anatomy
