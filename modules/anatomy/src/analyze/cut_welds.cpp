#include "analyze/cut_welds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <bodice/anatomy/plausible.hpp>

#include "analyze/thin_copy.hpp"

namespace bodice::anatomy {
namespace {

using body::LandmarkId;
using geometry::TriMesh;
using geometry::Vec3;

/// Depths of thin copies, of the stature: 9 and 14 mm. What the first does not part, the second may.
constexpr std::array kDepths = {0.0053, 0.0082};
/// A web hides an armpit or the crotch where the thin copy has it higher by this much of the stature; without
/// webs it is .003.
constexpr double kWeb = 0.01;

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

struct Web {
  LandmarkId id;
  const char* name;
};
constexpr std::array<Web, 3> kWebs = {{{LandmarkId::kArmpitL, "the left armpit"},
                                       {LandmarkId::kArmpitR, "the right armpit"},
                                       {LandmarkId::kPerineum, "the crotch"}}};

/// The webs that a thin copy shows, joined to a clause; empty if there are none.
std::string webs(const Anatomy& as_is, const Anatomy& apart) {
  std::string text;
  for (const Web& web : kWebs) {
    const auto at = static_cast<std::size_t>(web.id);
    const Vec3 offset = apart.landmarks[at].position - as_is.landmarks[at].position;
    if (offset.dot(apart.up) < kWeb * apart.stature_m) continue;
    text += (text.empty() ? "" : ", ") + std::string(web.name);
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

}  // namespace

engine::Result<Anatomy> cut_welds(const engine::Context& context, const TriMesh& mesh, const Options& options,
                                  Analyze analyze) {
  auto as_is = analyze(context, mesh, options);
  if (!is_welded(as_is)) return as_is;
  for (const double depth : kDepths) {
    const auto thin = thin_copy(context, mesh, depth);
    if (!thin) break;
    const auto found = analyze(context, thin->mesh, options);
    if (is_welded(found) || !contradictions(thin->mesh, *found).empty()) continue;
    Anatomy apart = carry_out(context, *thin, *found, mesh);
    const std::string where = as_is ? webs(*as_is, apart) : "";
    const bool better = !as_is || doubts(apart) <= doubts(*as_is);
    if (!better) break;
    if (as_is) apart.stages = as_is->stages;
    warn(where, *thin, apart);
    return apart;
  }
  return as_is;
}

}  // namespace bodice::anatomy
