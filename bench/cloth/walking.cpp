// Garments of a session on the built-in body that walks. The tables of its proxy are not solved anew,
// because that work behind the frames would be measured with them.
#include "walking.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/tryon/judge_frame.hpp>
#include <bodice/tryon/session.hpp>
#include <bodice/tryon/wearing.hpp>

#include <bench_support/median.hpp>
#include <bench_support/or_exit.hpp>
#include <bench_support/visible.hpp>

namespace bench {
namespace {

using namespace bodice;

constexpr double kStep_s = 1.0 / 60.0;
// The ramp to the clip and the first step pass before frames are timed; then two steps are.
constexpr int kFramesBefore = 90, kFrames = 120;
// Skin that shows is measured between the frames that are timed, in every tenth.
constexpr int kJudged = 10;

/// A garment on the built-in body, and the most that its frames may take and show.
struct Walk {
  const char* name;
  synth::GarmentKind kind;
  double edge_m;      ///< length of the garment's edges
  int skin_vertices;  ///< requested number of the body's vertices
  double bar_particles, bar_ms, bar_cm2;
};

/// What frames took, what layers cost in them, and what skin they showed.
struct WalkingFrames {
  std::size_t particles = 0, skin_vertices = 0;
  std::uint64_t hash = 0;
  double shown_cm2 = 0.0;  ///< the most of the judged frames
  std::vector<double> ms, searches, pairs, body_ms, stretch_p95, stretch_max;
};

/// Area of the cloth inside the posed skin of the last frame.
double shown_cm2(const engine::Context& context, const tryon::Session& session,
                 std::span<const geometry::Triangle> triangles) {
  geometry::TriMesh skin = session.body()->skin->input.skin;
  session.skin_positions(skin.positions);
  std::vector<geometry::Vec3> cloth(session.vertices());
  session.positions(cloth);
  const geometry::MeshDistance distance(context, skin);
  return 1e4 * tryon::cloth_inside(context, distance, cloth, triangles, kVisible_m).shown_m2;
}

WalkingFrames walk(const Walk& scene, int workers) {
  const auto executor = engine::make_tbb_executor(workers);
  const engine::Context context{.executor = executor.get()};
  tryon::SessionOptions options;
  options.moves = true, options.refits = false;
  tryon::Session session(context, options);
  session.play({.motion = "walk", .clip = {}});
  or_exit(session.submit(synth::BodyOptions{.vertices = scene.skin_vertices}).wait());
  session.frame(kStep_s);
  const tryon::WornGarment garment = or_exit(tryon::make_garment(
      context, *session.body()->skin, {.kind = scene.kind, .edge_length_m = scene.edge_m}));
  or_exit(session.dress({garment}));
  for (int k = 0; k < kFramesBefore; ++k) session.frame(kStep_s);
  WalkingFrames frames{.particles = session.vertices(),
                       .skin_vertices = session.body()->skin->input.skin.positions.size()};
  for (int k = 0; k < kFrames; ++k) {
    const cloth::FrameReport report = session.frame(kStep_s).cloth;
    frames.ms.push_back(1e-3 * report.frame_us);
    frames.body_ms.push_back(1e-3 * report.collision_us);
    frames.searches.push_back(static_cast<double>(report.layers.searches));
    frames.pairs.push_back(static_cast<double>(report.layers.pairs));
    frames.stretch_p95.push_back(report.stretch_p95);
    frames.stretch_max.push_back(report.stretch_max);
    if (k % kJudged == kJudged - 1)
      frames.shown_cm2 = std::max(frames.shown_cm2, shown_cm2(context, session, garment.mesh.triangles));
  }
  frames.hash = session.hash();
  return frames;
}

void print_bar(const char* what, double value, double bar, const char* unit) {
  std::printf("%-56s %8.2f %-3s  at most %5.2f  %s\n", what, value, unit, bar, value <= bar ? "" : "MISSED");
}

}  // namespace

void print_walking() {
  constexpr Walk kWalks[] = {
      {"skirt", synth::GarmentKind::kSkirt, 7.8e-3, 8850, 1.0e4, 16.0, 5.0},
      {"dress", synth::GarmentKind::kTunic, 5.45e-3, 13000, 1.5e4, 25.0, 0.0},
  };
  for (const Walk& scene : kWalks) {
    for (const int workers : {1, 2}) {
      const WalkingFrames frames = walk(scene, workers);
      const double ms = median(frames.ms);
      std::printf(
          "a %s of %zu particles on a body of %zu vertices that walks, 8 substeps, self-contact, %d "
          "workers:\n"
          "  a frame takes %.1f ms (body contact %.1f, all workers), %.0f searches, %.0f pairs, stretch %.1f "
          "%% at 95 %% and %.0f %% at most; medians of %d; hash %016llx\n",
          scene.name, frames.particles, frames.skin_vertices, workers, ms, median(frames.body_ms),
          median(frames.searches), median(frames.pairs), 1e2 * median(frames.stretch_p95),
          1e2 * median(frames.stretch_max), kFrames, static_cast<unsigned long long>(frames.hash));
      if (workers == 1) continue;
      char what[80];
      std::snprintf(what, sizeof what, "%s, a body that walks, frame of %.0f particles, median", scene.name,
                    scene.bar_particles);
      print_bar(what, ms * scene.bar_particles / static_cast<double>(frames.particles), scene.bar_ms, "ms");
      std::snprintf(what, sizeof what, "%s, cloth more than .5 mm in the posed skin", scene.name);
      print_bar(what, frames.shown_cm2, scene.bar_cm2, "cm2");
      std::printf("\n");
    }
  }
}

}  // namespace bench
