#include <bodice/anatomy/anatomy.hpp>
#include <bodice/anatomy/plausible.hpp>
#include <bodice/engine/catch_canceled.hpp>
#include <bodice/engine/stage_timer.hpp>
#include <bodice/geometry/fins.hpp>

#include "analyze/cut_welds.hpp"
#include "analyze/low_armpits.hpp"
#include "check/diagnostics.hpp"
#include "check/flat_parts.hpp"
#include "check/fold_doubts.hpp"
#include "check/fused_limbs.hpp"
#include "check/sixth_end.hpp"
#include "check/unequal_arms.hpp"
#include "landmarks/find_landmarks.hpp"
#include "landmarks/stature.hpp"
#include "segment/segment.hpp"
#include "skin/halve_edges.hpp"
#include "skin/split_pinches.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using engine::Error;
using engine::ErrorCode;
using engine::StageTimer;
using engine::Warning;
using geometry::Vec3;

/// The largest Mahalanobis distance of five extremities that count as those of a body.
constexpr double kWorstDistance = 3.0;

Error no_body(const std::string& why) {
  return {ErrorCode::kUnusableGeometry, "No human body can be made out: " + why,
          "Give one closed skin with a head, two arms and two legs, apart from floor, furniture and others."};
}

/// The warning of a result that was forced.
Warning not_human(const std::string& why) {
  return {"not-human", "", "The analysis went on although " + why + ".",
          "Check the landmarks and the parts."};
}

Vec3 upwards(const Skin& skin, const Landmarks& marks, geometry::Index perineum) {
  const Vec3 up = marks.at(LandmarkId::kNeck) - skin.mesh.positions[perineum];
  const double length = up.norm();
  return length > 0.0 ? Vec3(up / length) : Vec3(Vec3::UnitY());
}

/// Analyzes a skin without changing it. `anatomy` has the stages so far.
engine::Result<Anatomy> analyze_skin(const engine::Context& context, const Skin& skin, const Options& options,
                                     Anatomy anatomy) {
  StageTimer geodesic_timer(context, anatomy.stages, "geodesic");
  const std::optional<Extremities> found = find_extremities(context, skin);
  geodesic_timer.stop();
  if (!found) return no_body("its skin has no five extremities far from each other.");
  if (found->mahalanobis > kWorstDistance)
    return no_body("its five extremities do not lie at the distances of a head, two hands and two feet.");

  StageTimer anatomy_timer(context, anatomy.stages, "anatomy");
  const Sides sides = find_sides(context, skin, *found);
  const BodyExtremities tips = in_body_order(*found, sides);
  const BodyCoordinates coordinates(context, skin, tips);
  const std::optional<std::string> sixth_end = sixth_end_clause(skin, tips, coordinates.size_m());
  if (sixth_end && !options.force) return no_body(*sixth_end + ".");
  const CheckedLandmarks landmarks = find_landmarks(context, skin, coordinates);
  if (const auto fused = fused_limbs_error(skin, coordinates, landmarks)) return *fused;
  anatomy.stature_m = find_stature(skin, coordinates, landmarks.marks);
  anatomy.up = upwards(skin, landmarks.marks, coordinates.perineum());
  anatomy.landmarks = to_list(skin, landmarks.marks);
  anatomy_timer.stop();

  StageTimer segment_timer(context, anatomy.stages, "segment");
  anatomy.part = segment(context, skin, coordinates);
  segment_timer.stop();
  anatomy.warnings =
      diagnose({skin, *found, sides, coordinates, landmarks}, options.profile, anatomy.stature_m);
  if (sixth_end) anatomy.warnings.push_back(not_human(*sixth_end));
  return anatomy;
}

/// Removes the vertices that were added to a skin from its result. `origin` has the original vertex of each
/// added one.
void remove_added(const std::vector<geometry::Index>& origin, std::size_t vertices, Anatomy& anatomy) {
  anatomy.part.resize(vertices);
  for (body::Landmark& mark : anatomy.landmarks)
    if (mark.vertex != geometry::kNoIndex && mark.vertex >= vertices)
      mark.vertex = origin[mark.vertex - vertices];
}

/// Analyzes a skin. A coarse one is analyzed with finer triangles of the same surface.
engine::Result<Anatomy> analyze_fine_enough(const engine::Context& context, const Skin& skin,
                                            const Options& options, Anatomy anatomy) {
  const std::size_t vertices = skin.mesh.positions.size();
  if (vertices > kCoarse || vertices < kNoBody)
    return analyze_skin(context, skin, options, std::move(anatomy));
  StageTimer finer_timer(context, anatomy.stages, "finer skin");
  const FinerSkin finer = halve_edges(skin);
  Skin fine = make_skin(context, finer.mesh);
  fine.open_edges = skin.open_edges;
  finer_timer.stop();
  auto result = analyze_skin(context, fine, options, std::move(anatomy));
  if (result.ok()) remove_added(finer.origin, vertices, *result);
  return result;
}

Warning touches(std::size_t vertices) {
  return engine::note(
      "skin-touches", "",
      "The skin touches itself in " + std::to_string(vertices) +
          " welded vertices; they were taken apart, so that no path along the skin leads across.",
      "Weld less, or move the parts that touch apart.");
}

/// Analyzes a skin. One that touches itself is analyzed with its touching parts taken apart.
engine::Result<Anatomy> analyze_apart(const engine::Context& context, const Skin& skin,
                                      const Options& options, Anatomy anatomy) {
  SplitSkin split;
  if (!surely_unpinched(skin)) split = split_pinches(skin);
  if (split.origin.empty()) return analyze_fine_enough(context, skin, options, std::move(anatomy));
  const Skin apart = make_skin(context, split.mesh);
  auto result = analyze_fine_enough(context, apart, options, std::move(anatomy));
  if (!result.ok()) return result;
  remove_added(split.origin, skin.mesh.positions.size(), *result);
  result->warnings.push_back(touches(split.origin.size()));
  return result;
}

/// The mesh without the triangles of fins; all vertices stay. Tips of fins are no extremities, and paths
/// along fins lead across the body.
geometry::TriMesh without_fins(const geometry::TriMesh& mesh) {
  const std::vector<bool> fin = geometry::find_fins(mesh, geometry::mesh_edges(mesh));
  geometry::TriMesh kept{mesh.positions, {}};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (!fin[t]) kept.triangles.push_back(mesh.triangles[t]);
  return kept;
}

/// The result, or an error if it fits no human body and `force` is not set.
engine::Result<Anatomy> checked(const geometry::TriMesh& mesh, engine::Result<Anatomy> found, bool force) {
  if (!found) return found;
  const std::vector<std::string> clauses = contradictions(mesh, *found);
  if (clauses.empty()) {
    warn_of_flat_parts(mesh, *found);
    return found;
  }
  std::string why;
  for (const std::string& clause : clauses) why += (why.empty() ? "" : ", ") + clause;
  if (!force) {
    engine::Error refusal = no_body(why + ".");
    refusal.remedy += " Forced (program: --force), it is fitted all the same.";
    return refusal;
  }
  found->warnings.push_back(not_human(why));
  return found;
}

engine::Result<Anatomy> analyze_mesh(const engine::Context& context, const geometry::TriMesh& mesh,
                                     const Options& options) {
  Anatomy anatomy;
  StageTimer skin_timer(context, anatomy.stages, "skin");
  const Skin skin = make_skin(context, mesh);
  skin_timer.stop();
  if (skin.edges.non_manifold == 0) return analyze_apart(context, skin, options, std::move(anatomy));
  const geometry::TriMesh clean = without_fins(mesh);
  return analyze_apart(context, make_skin(context, clean), options, std::move(anatomy));
}

}  // namespace

engine::Result<Anatomy> analyze(const engine::Context& context, const geometry::TriMesh& mesh,
                                const Options& options) {
  if (mesh.empty()) return no_body("the mesh has no triangles.");
  return engine::catch_canceled("The analysis of the body", [&] {
    auto found = checked(mesh, cut_welds(context, mesh, options, analyze_mesh), options.force);
    if (!found) return found;
    doubt_folds(options, *found);
    const bool cut = was_cut(*found);
    if (cut) doubt_unequal_arms(*found);
    if (cut || was_closed(options)) doubt_low_armpits(context, mesh, *found);
    if (cut) doubt_armpits_by_room(context, mesh, *found);
    if (cut) doubt_high_crotch(context, mesh, *found);
    return found;
  });
}

}  // namespace bodice::anatomy
