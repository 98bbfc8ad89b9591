// The skirt of a session on the built-in body that walks. The tables of its proxy are not solved anew,
// because that work behind the frames would be measured with them.
#include "walking.hpp"

#include <cstdio>
#include <memory>
#include <vector>

#include <bodice/tryon/session.hpp>
#include <bodice/tryon/wearing.hpp>

#include <bench_support/median.hpp>
#include <bench_support/or_exit.hpp>

namespace bench {
namespace {

using namespace bodice;

constexpr double kStep_s = 1.0 / 60.0;
// With triangles of this edge the skirt has 10,220 particles.
constexpr double kEdge_m = 7.8e-3;
// The ramp to the clip and the first step pass before frames are timed; then two steps are.
constexpr int kFramesBefore = 90, kFrames = 120;
// The bar is on a frame of so many particles.
constexpr double kParticles = 1e4;
constexpr double kMostFrame_ms = 16.0;

/// What frames took, and what layers cost in them.
struct WalkingFrames {
  std::size_t particles = 0;
  std::uint64_t hash = 0;
  std::vector<double> ms, searches, pairs, body_ms;
};

WalkingFrames walk(int workers) {
  const auto executor = engine::make_tbb_executor(workers);
  const engine::Context context{.executor = executor.get()};
  tryon::SessionOptions options;
  options.moves = true, options.refits = false;
  tryon::Session session(context, options);
  session.play({.motion = "walk", .clip = {}});
  or_exit(session.submit(synth::BodyOptions{}).wait());
  session.frame(kStep_s);
  or_exit(session.dress(
      {or_exit(tryon::make_garment(context, *session.body()->skin, {.edge_length_m = kEdge_m}))}));
  for (int k = 0; k < kFramesBefore; ++k) session.frame(kStep_s);
  WalkingFrames frames{.particles = session.vertices()};
  for (int k = 0; k < kFrames; ++k) {
    const cloth::FrameReport report = session.frame(kStep_s).cloth;
    frames.ms.push_back(1e-3 * report.frame_us);
    frames.body_ms.push_back(1e-3 * report.collision_us);
    frames.searches.push_back(static_cast<double>(report.layers.searches));
    frames.pairs.push_back(static_cast<double>(report.layers.pairs));
  }
  frames.hash = session.hash();
  return frames;
}

}  // namespace

void print_walking() {
  for (const int workers : {1, 2}) {
    const WalkingFrames frames = walk(workers);
    const double ms = median(frames.ms), of_10k_ms = ms * kParticles / static_cast<double>(frames.particles);
    std::printf(
        "a skirt of %zu particles on a body that walks, 8 substeps, self-contact, %d workers: a frame takes "
        "%.1f ms (body contact %.1f, all workers), %.0f searches, %.0f pairs; medians of %d; hash %016llx\n",
        frames.particles, workers, ms, median(frames.body_ms), median(frames.searches), median(frames.pairs),
        kFrames, static_cast<unsigned long long>(frames.hash));
    if (workers == 2)
      std::printf("10k particles, a body that walks, frame, median %29.2f ms   at most %5.2f  %s\n\n",
                  of_10k_ms, kMostFrame_ms, of_10k_ms <= kMostFrame_ms ? "" : "MISSED");
  }
}

}  // namespace bench
