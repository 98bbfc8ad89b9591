#include "faces.hpp"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <vector>

#include <bodice/proxy/proxy_file.hpp>
#include <bodice/tryon/judge_frame.hpp>
#include <bodice/tryon/rigged_body.hpp>
#include <bodice/tryon/wearing.hpp>

#include <bench_support/median.hpp>
#include <bench_support/or_exit.hpp>
#include "causes.hpp"
#include "conditions.hpp"
#include "crossed.hpp"
#include "sheet.hpp"

namespace bench {
namespace {

using namespace bodice;
using geometry::Vec3;

constexpr std::size_t kStep = 6;    // frames from one to the next that causes are found in
constexpr double kTight_m = 0.007;  // a garment starts as tight where its median gap is less
// Bars, in the units of the columns; the fold of a knee or armpit that a garment starts in has its own.
constexpr double kStanding_cm2 = 0.0, kInFold_cm2 = 2.0, kWalking_cm2 = 5.0, kGapMedian_mm = 2.5,
                 kGap95_mm = 5.0;

/// Gaps between cloth and skin, meters, by area at the middles of the triangles.
struct Gaps {
  double median = 0.0, p95 = 0.0;
};

Gaps gaps_of(const geometry::MeshDistance& skin, const std::vector<Vec3>& at,
             const std::vector<geometry::Triangle>& triangles) {
  std::vector<std::pair<double, double>> gap_and_area;
  double total = 0.0;
  for (const auto& [a, b, c] : triangles) {
    const double area = 0.5 * (at[b] - at[a]).cross(at[c] - at[a]).norm();
    gap_and_area.push_back({skin.signed_distance((at[a] + at[b] + at[c]) / 3.0), area});
    total += area;
  }
  std::ranges::sort(gap_and_area);
  auto quantile = [&](double share) {
    double sum = 0.0;
    for (const auto& [gap, area] : gap_and_area)
      if ((sum += area) >= share * total) return gap;
    return gap_and_area.back().first;
  };
  return {quantile(0.5), quantile(0.95)};
}

/// The numbers of a row.
struct Row {
  double start_cm2 = 0.0, end_cm2 = 0.0;  ///< cloth more than half a millimeter inside the skin
  double worst_cm2 = 0.0;                 ///< largest of the frames after the first ten; walking only
  double overlapped_cm2 = 0.0;  ///< besides, where the skin overlaps itself: at the end or in that frame
  Gaps start, end;
  CrossedSpan crossed;  ///< walking only
  tryon::DrapeReport report;
};

tryon::ClothInside inside(const engine::Context& context, const geometry::MeshDistance& skin,
                          const std::vector<Vec3>& at, const geometry::TriMesh& garment) {
  return tryon::cloth_inside(context, skin, at, garment.triangles, kVisible_m);
}

void print_head_of_faces() {
  std::printf("%-36s %-5s %6s %6s %8s %8s %8s %8s %15s %15s %8s %8s %11s\n", "", "", "parti-", "ms", "thick",
              "cm2", "cm2", "cm2", "gap mm at start", "gap mm at end", "stretch", "stretch", "crossings");
  std::printf("%-36s %-5s %6s %6s %8s %8s %8s %8s %15s %15s %8s %8s %11s\n", "garment", "body", "cles",
              "median", "mm", "start", "inside", "overlap", "median    95 %", "median    95 %", "p95 %",
              "max %", "start   end");
}

void print_row(const std::string& name, const char* body, const Row& row, double bar_cm2) {
  const bool walks = body[0] == 'w';
  const double inside = walks ? row.worst_cm2 : row.end_cm2;
  const tryon::DrapeReport& r = row.report;
  std::printf("%-36s %-5s %6zu %6.2f %8.2f %8.2f %8.2f %8.2f %7.1f %7.1f %7.1f %7.1f %8.2f %8.1f %5zu %5zu",
              name.c_str(), body, r.particles, r.frame_ms_median, 1e3 * r.thickness_m, row.start_cm2, inside,
              row.overlapped_cm2, 1e3 * row.start.median, 1e3 * row.start.p95, 1e3 * row.end.median,
              1e3 * row.end.p95, 1e2 * r.stretch_p95, 1e2 * r.stretch_max, r.crossings_start,
              r.crossings_end);
  if (walks)
    std::printf("  with room %zu/%zu (pressed before %zu/%zu), without %zu/%zu", row.crossed.worst.with_room,
                row.crossed.end.with_room, row.crossed.worst.pressed_before, row.crossed.end.pressed_before,
                row.crossed.worst.without_room, row.crossed.end.without_room);
  if (r.crossings_end > 0) std::printf("  MISSED crossings");
  if (inside > bar_cm2) std::printf("  MISSED inside");
  const bool tight = !walks && row.start.median < kTight_m;
  if (tight && (1e3 * row.end.median > kGapMedian_mm || 1e3 * row.end.p95 > kGap95_mm))
    std::printf("  MISSED gap");
  std::printf(r.finite ? "\n" : "  NOT FINITE\n");
  std::fflush(stdout);
}

/// Moves the vertices of a garment toward the skin, to a millimeter off it at most.
void tighten(const geometry::MeshDistance& skin, double by_m, geometry::TriMesh& garment) {
  constexpr double kLeast_m = 1e-3;
  if (!(by_m > 0.0)) return;
  for (Vec3& p : garment.positions) {
    const geometry::SurfacePoint below = skin.closest_point(p);
    const double gap_m = below.signed_distance, step_m = std::clamp(gap_m - kLeast_m, 0.0, by_m);
    if (gap_m > 0.0) p += step_m / gap_m * (below.point - p);
  }
}

Row stand(const engine::Context& context, const FacesOptions& o, const Outfit& outfit, Sheet& sheet) {
  Body body = load_body(context, outfit.body, proxy::Tier::kRelief, o.cache);
  tryon::WornGarment garment = load_garment(context, outfit, body);
  tighten(*body.skin.distance, o.tighter_m, garment.mesh);
  tryon::PreparedBody prepared{std::move(body.skin), {.proxy = std::move(body.proxy)}};
  const geometry::MeshDistance& skin = *prepared.skin.distance;
  tryon::DrapeOptions settings = o.drape;
  settings.frames = o.standing_frames, settings.kept_frames = 2;
  const tryon::DrapeResult draped = or_exit(tryon::drape(context, prepared, {garment}, settings));
  const std::vector<Vec3>& end = draped.garments.front().frames.back();
  sheet.add(prepared.skin.input.skin.positions, prepared.skin.input.skin.triangles, garment, end);
  const geometry::TriMesh& mesh = garment.mesh;
  const tryon::ClothInside last = inside(context, skin, end, mesh);
  return {.start_cm2 = 1e4 * inside(context, skin, mesh.positions, mesh).shown_m2,
          .end_cm2 = 1e4 * last.shown_m2,
          .overlapped_cm2 = 1e4 * last.overlapped_m2,
          .start = gaps_of(skin, mesh.positions, mesh.triangles),
          .end = gaps_of(skin, end, mesh.triangles),
          .report = draped.report};
}

/// The body with a proxy that follows its rig; the proxy is kept from run to run where there is a cache.
tryon::PreparedBody bound_body(const engine::Context& context, tryon::SegmentedSkin skin,
                               const std::string& name, const std::filesystem::path& cache) {
  const std::filesystem::path kept = cache / (name + "_bound.bodice");
  if (!cache.empty() && std::filesystem::exists(kept))
    return {std::move(skin), {.proxy = or_exit(proxy::load(kept))}};
  tryon::PreparedBody body = or_exit(tryon::fit_bound_proxy(context, std::move(skin), {}));
  if (!cache.empty()) {
    std::filesystem::create_directories(cache);
    or_exit(proxy::save(body.fit.proxy, kept));
  }
  return body;
}

/// Prints why cloth is inside the skin in the worst frame and on the mean, and where layers cross.
void explain(const engine::Context& context, const Judged& judged, const std::vector<Crossed>& crossed,
             std::size_t worst) {
  const std::size_t kept = crossed.size(), count = (kept - kFirstFrames + kStep - 1) / kStep;
  const auto most = std::ranges::max_element(crossed, {}, &Crossed::with_room) - crossed.begin();
  print_crossed(context, judged, static_cast<std::size_t>(most));
  print_crossed(context, judged, kept - 1);
  Causes mean;
  for (std::size_t k = kFirstFrames; k < kept; k += kStep)
    mean.add(find_causes(context, judged, k), 1.0 / static_cast<double>(count));
  print_causes(find_causes(context, judged, worst), "frame " + std::to_string(worst));
  print_causes(mean, "mean");
}

/// A garment on a body that walks.
struct WalkScene {
  tryon::PreparedBody body;
  tryon::BodyMotion motion;
  tryon::WornGarment garment;
};

WalkScene load_walk(const engine::Context& context, const FacesOptions& o, const Outfit& outfit) {
  tryon::SegmentedSkin skin = or_exit(tryon::segment_file(context, outfit.body, {}));
  or_exit(tryon::give_rig(context, tryon::BodyFile{outfit.body}, skin));
  std::vector<engine::Warning> warnings;
  tryon::BodyMotion motion =
      or_exit(tryon::find_motion(context, skin, {.motion = "walk", .clip = {}}, warnings));
  tryon::PreparedBody body = bound_body(context, std::move(skin), outfit.body.stem().string(), o.cache);
  io::ImportedMesh mesh = or_exit(io::import_garment(context, outfit.garment, body.skin.input.frame));
  tryon::WornGarment garment{.name = outfit.name, .mesh = std::move(mesh.skin)};
  tighten(*body.skin.distance, o.tighter_m, garment.mesh);
  garment.held = tryon::held_vertices(garment.mesh, body.skin);
  return {std::move(body), std::move(motion), std::move(garment)};
}

/// Moves vertices by less than a micrometer, differently for each start.
void displace(int start, geometry::TriMesh& garment) {
  constexpr double kStep_m = 1e-7;
  constexpr std::size_t kDifferent = 7;
  for (std::size_t i = 0; i < garment.positions.size(); ++i)
    garment.positions[i].x() += kStep_m * start * static_cast<double>(i % kDifferent);
}

Row walk(const engine::Context& context, const FacesOptions& o, const WalkScene& scene, int start,
         Sheet& sheet) {
  const auto& [body, motion, at_file] = scene;
  tryon::WornGarment garment = at_file;
  displace(start, garment.mesh);
  tryon::DrapeOptions settings = o.drape;
  settings.motion = &motion;
  settings.frames = std::max(20, static_cast<int>(motion.clip.duration_s / settings.dt_s));
  settings.kept_frames = settings.frames + 1;
  const tryon::DrapeResult draped = or_exit(tryon::drape(context, body, {garment}, settings));
  const std::vector<Vec3>& end = draped.garments.front().frames.back();
  if (start == 0) sheet.add(draped.body_frames.back(), body.skin.input.skin.triangles, garment, end);
  const geometry::MeshDistance posed(context, {draped.body_frames.back(), body.skin.input.skin.triangles});
  Row row{.start_cm2 = 1e4 * draped.report.kept.front().inside.shown_m2,
          .end_cm2 = 1e4 * draped.report.kept.back().inside.shown_m2,
          .start = gaps_of(*body.skin.distance, garment.mesh.positions, garment.mesh.triangles),
          .end = gaps_of(posed, end, garment.mesh.triangles),
          .report = draped.report};
  const auto settled = draped.report.kept.begin() + kFirstFrames;
  const auto worst = std::max_element(settled, draped.report.kept.end(), [](const auto& a, const auto& b) {
    return a.inside.shown_m2 < b.inside.shown_m2;
  });
  row.worst_cm2 = 1e4 * worst->inside.shown_m2, row.overlapped_cm2 = 1e4 * worst->inside.overlapped_m2;
  const Judged judged{body, motion, garment.mesh, draped};
  const std::vector<Crossed> crossed = find_crossed(context, judged);
  row.crossed = span_of(crossed);
  if (o.causes)
    explain(context, judged, crossed, static_cast<std::size_t>(worst - draped.report.kept.begin()));
  return row;
}

/// A number of several walks that differ by their starts.
void print_spread(const char* what, std::vector<double> values) {
  std::ranges::sort(values);
  std::printf("  %s %.1f (%.1f to %.1f)", what, median(values), values.front(), values.back());
}

void judge_walks(const engine::Context& context, const FacesOptions& o, const Outfit& outfit, Sheet& sheet) {
  const WalkScene scene = load_walk(context, o, outfit);
  std::vector<double> inside_cm2, crossings;
  for (int start = 0; start < o.starts; ++start) {
    const Row row = walk(context, o, scene, start, sheet);
    print_row(outfit.name, "walks", row, kWalking_cm2);
    inside_cm2.push_back(row.worst_cm2);
    crossings.push_back(static_cast<double>(row.report.crossings_end));
  }
  if (o.starts == 1) return;
  std::printf("%-36s %d starts, median (least to most):", outfit.name.c_str(), o.starts);
  print_spread("cm2 inside", inside_cm2);
  print_spread("crossings at the end", crossings);
  std::printf("\n");
}

}  // namespace

bool judge_faces(const engine::Context& context, const FacesOptions& options) {
  Sheet sheet;
  print_head_of_faces();
  const std::vector<Outfit> outfits = find_outfits(options.data, options.only, false);
  for (const Outfit& outfit : outfits) {
    if (options.walking_only) break;
    const Row row = stand(context, options, outfit, sheet);
    print_row(outfit.name, "stand", row, row.start_cm2 > 0.0 ? kInFold_cm2 : kStanding_cm2);
  }
  for (const Outfit& outfit : outfits) judge_walks(context, options, outfit, sheet);
  return options.sheet.empty() || sheet.write(options.sheet);
}

}  // namespace bench
