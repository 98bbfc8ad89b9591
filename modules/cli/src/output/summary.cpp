#include "output/summary.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

namespace bodice::inline v0_1::cli {
namespace {

[[gnu::format(printf, 2, 3)]] void add_line(std::string& text, const char* format, ...) {
  char line[512];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  text.append(line).push_back('\n');
}

/// The largest cluster error E_j of torso and limbs beside its threshold, for tiers with clusters.
void add_clusters(std::string& text, const fitting::FitResult& fit) {
  double torso_m = 0.0, limbs_m = 0.0;
  for (const fitting::PartFit& part : fit.parts)
    if (part.cluster_error) {
      double& worst = body::is_torso(part.part) ? torso_m : limbs_m;
      worst = std::max(worst, part.cluster_error->max_m);
    }
  if (torso_m == 0.0 && limbs_m == 0.0) return;
  add_line(text, "clusters    error up to %.2f mm on the torso (mu %.2f), %.2f mm on the limbs (mu %.2f)",
           torso_m * 1e3, fit.mu_torso_m * 1e3, limbs_m * 1e3, fit.mu_limbs_m * 1e3);
}

void add_body(std::string& text, const tryon::PreparedBody& body, bool cropped) {
  const io::ImportedMesh& input = body.skin.input;
  const fitting::FitResult& fit = body.fit;
  const bool any = input.shape == io::Shape::kAny;
  const double height_m =
      any ? geometry::bounding_box(input.skin.positions).size().y() : body.skin.anatomy.stature_m;
  add_line(text, "%-12s%s%s%s: %zu vertices, %zu triangles, unit %s, %.3f m tall", any ? "thing" : "body",
           input.file.c_str(), input.mesh.empty() ? "" : ", mesh ", input.mesh.c_str(),
           input.skin.positions.size(), input.skin.triangles.size(), input.unit.c_str(), height_m);
  add_line(text, "proxy       tier %s: %zu ellipsoids, %.1f KB", proxy::name(fit.proxy.tier()).data(),
           fit.proxy.ellipsoids().size(), static_cast<double>(fit.proxy.bytes()) / 1024.0);
  add_line(text, "accuracy    from its surface to the skin %.2f mm mean, %.2f mm at 95 %%, up to %.1f mm%s",
           fit.accuracy.gap_m.mean * 1e3, fit.accuracy.gap_m.p95 * 1e3, fit.accuracy.gap_m.max * 1e3,
           cropped ? " (of the whole body, before it was cropped)" : "");
  add_line(text, "            interior covered %.2f %%; skin outside %.2f %% of the area, up to %.2f mm deep",
           fit.accuracy.interior_covered_percent, fit.accuracy.skin_outside_percent,
           fit.accuracy.skin_outside_depth_m * 1e3);
  add_clusters(text, fit);
}

void add_drape(std::string& text, const tryon::DrapeReport& d) {
  add_line(
      text,
      "drape       %d frames, %zu particles %.1f mm off the skin, %.2f ms a frame (median), %.2f ms (99 %%)",
      d.frames, d.particles, d.thickness_m * 1e3, d.frame_ms_median, d.frame_ms_p99);
  add_line(text,
           "true skin   %zu particles deeper than 1 mm at the end; deepest ever %.2f mm (frame %d); %.2f %% "
           "of the "
           "cloth inside",
           d.penetration_over_1mm, d.penetration_max_m * 1e3, d.worst_frame, d.pierced_share * 100.0);
  add_line(text, "cloth       stretch %.1f %% at 95 %%, median speed %.1f mm/s, %zu inside the proxy%s",
           d.stretch_p95 * 100.0, d.median_speed_m_s * 1e3, d.inside_union, d.finite ? "" : ", NOT FINITE");
  if (d.crossings_start + d.crossings_end > 0)
    add_line(
        text,
        "layers      %zu pairs of triangles of the cloth cross at the start, of which %zu are separated; "
        "%zu at the end",
        d.crossings_start, d.crossings_separated, d.crossings_end);
  for (const tryon::PropReport& p : d.props)
    add_line(text,
             "prop        %s: %zu ellipsoids, %.2f mm mean; %zu particles deeper than 1 mm in it at the end; "
             "deepest "
             "ever %.2f mm (frame %d)",
             p.name.c_str(), p.ellipsoids, p.accuracy.gap_m.mean * 1e3, p.over_1mm, p.deepest_m * 1e3,
             p.worst_frame);
  for (const tryon::DrapedGarment& garment : d.garments)
    for (const tryon::TackedPiece& p : garment.tacked)
      add_line(text, "tacked      %s: piece %zu to piece %zu at %zu points", garment.name.c_str(), p.piece,
               p.onto, p.points);
  if (d.fit_map && d.fit_map->map == tryon::FitMap::kEase)
    add_line(text, "fit map     ease: red %.0f mm off the skin, blue %.0f mm or more", 1e3 * d.fit_map->tight,
             1e3 * d.fit_map->loose);
  if (d.fit_map && d.fit_map->map == tryon::FitMap::kStrain)
    add_line(text, "fit map     strain: blue %.0f %%, red %.0f %% or more", 1e2 * d.fit_map->loose,
             1e2 * d.fit_map->tight);
}

void add_warnings(std::string& text, std::span<const engine::Warning> warnings) {
  for (const engine::Warning& w : warnings)
    text += (w.note ? "note        " : "warning     ") + (w.part.empty() ? "" : w.part + ": ") + w.message +
            (w.remedy.empty() ? "" : " " + w.remedy) + "\n";
}

}  // namespace

std::string summary_text(const tryon::PreparedBody& body, const tryon::DrapeReport* drape,
                         const std::vector<std::string>& files, bool cropped) {
  std::string text;
  add_body(text, body, cropped);
  if (drape) add_drape(text, *drape);
  std::string stages;
  std::vector<engine::StageTime> all_stages = body.all_stages();
  if (drape) all_stages.insert(all_stages.end(), drape->stages.begin(), drape->stages.end());
  for (const engine::StageTime& stage : all_stages) {
    char item[64];
    std::snprintf(item, sizeof item, "%s%s %.0f", stages.empty() ? "" : ", ", stage.name.c_str(), stage.ms);
    stages += item;
  }
  add_line(text, "ms          %s", stages.c_str());
  add_warnings(text, body.all_warnings());
  if (drape) add_warnings(text, drape->warnings);
  for (const std::string& file : files) add_line(text, "wrote       %s", file.c_str());
  return text;
}

}  // namespace bodice::cli
