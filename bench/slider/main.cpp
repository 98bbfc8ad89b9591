// A slider makes the built-in body, or that of --body, wider and narrower again while it wears a skirt: how
// long do the frames take, and is the proxy of each shape as good as one that is fitted to it from scratch?
// The body stands, or moves with --motion. Bars: no frame above 8 ms with 5,000 particles and two workers,
// the error at most 1.2 times that of the fit from scratch.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>

#include <bodice/tryon/judge_frame.hpp>
#include <bodice/tryon/session.hpp>
#include <bodice/tryon/wearing.hpp>

#include <bench_support/or_exit.hpp>
#include <bench_support/origin.hpp>

namespace {

using namespace bodice;
using geometry::Vec3;

constexpr double kFrame_s = 1.0 / 60.0;
constexpr double kMostFrame_ms = 8.0, kMostOverScratch = 1.2;
constexpr double kNear_m = 0.03;
constexpr int kFramesBefore = 120;  // what a frame takes on this machine without a slider

struct Arguments {
  std::string body, motion;
  double seconds = 5.0, girth_mm = 25.0, edge_mm = 11.0;
  int workers = 2, judged = 4;
};

/// The skin made wider around the hips and the waist by at most `by_m`, smoothly along the body's height.
std::vector<Vec3> widened(const tryon::SegmentedSkin& skin, const std::vector<Vec3>& normals, double by_m) {
  std::vector<Vec3> positions = skin.input.skin.positions;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const body::Part part = skin.anatomy.part[v];
    const bool arm = part == body::Part::kUpperArmL || part == body::Part::kUpperArmR ||
                     part == body::Part::kForearmL || part == body::Part::kForearmR;
    const double off = (positions[v].y() / skin.anatomy.stature_m - 0.55) / 0.1;
    if (!arm) positions[v] += by_m * std::exp(-0.5 * off * off) * normals[v];
  }
  return positions;
}

/// A session with the skirt on, after its first second.
class Dressed {
 public:
  Dressed(const engine::Context& context, const Arguments& arguments) : context_(context) {
    tryon::SessionOptions options;
    options.moves = !arguments.motion.empty();
    session_ = std::make_unique<tryon::Session>(context, options);
    tryon::BodySource source = synth::BodyOptions{};
    if (!arguments.body.empty()) source = tryon::BodyFile{arguments.body};
    if (options.moves) session_->play({.motion = arguments.motion, .clip = {}});
    bench::or_exit(session_->submit(source).wait());
    frame();
    skin_ = session_->body()->skin;
    normals_ = geometry::vertex_normals(skin_->input.skin);
    bench::or_exit(session_->dress(
        {bench::or_exit(tryon::make_garment(context, *skin_, {.edge_length_m = 1e-3 * arguments.edge_mm}))}));
    for (int i = 0; i < 60; ++i) frame();
  }

  /// Runs a frame at its time, as a program that draws does, and returns what it took, milliseconds.
  double frame() {
    const auto begin = std::chrono::steady_clock::now();
    outcome_ = session_->frame(kFrame_s);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    std::this_thread::sleep_until(begin + std::chrono::duration<double>(kFrame_s));
    return took.count();
  }
  void reshape(double by_m) { bench::or_exit(session_->reshape(widened(*skin_, normals_, by_m))); }
  /// Frames until the requested shape is in use.
  int wait_for(double by_m) {
    const std::vector<Vec3> wanted = widened(*skin_, normals_, by_m);
    int frames = 0;
    while (session_->body()->skin->input.skin.positions != wanted && ++frames < 1200) frame();
    return frames;
  }

  tryon::Session& session() { return *session_; }
  const tryon::FrameOutcome& outcome() const { return outcome_; }

 private:
  const engine::Context& context_;
  std::unique_ptr<tryon::Session> session_;
  std::shared_ptr<const tryon::SegmentedSkin> skin_;
  std::vector<Vec3> normals_;
  tryon::FrameOutcome outcome_;
};

/// Mean error of a proxy within 30 mm of the skin at rest, millimeters.
double error_mm(const engine::Context& context, const tryon::SegmentedSkin& skin,
                const proxy::BodyProxy& proxy) {
  const collision::Collider collider(proxy);
  const auto found = tryon::measure_proxy_error(context, collider, skin.input.skin, *skin.distance, kNear_m);
  return 1e3 * found.error_m.mean;
}

/// Sweeps the slider there and back; times of all frames.
std::vector<double> sweep(Dressed& dressed, const Arguments& arguments, int& shapes) {
  std::vector<double> frame_ms;
  const int frames = static_cast<int>(std::lround(arguments.seconds / kFrame_s));
  std::uint64_t hash = dressed.session().body()->proxy.hash();
  for (int i = 0; i < frames; ++i) {
    const double share = 1.0 - std::abs(2.0 * (i + 1) / frames - 1.0);
    dressed.reshape(1e-3 * arguments.girth_mm * share);
    frame_ms.push_back(dressed.frame());
    shapes += dressed.session().body()->proxy.hash() != hash;
    hash = dressed.session().body()->proxy.hash();
  }
  return frame_ms;
}

/// The largest ratio of a shape's error to that of a fit from scratch.
double worst_over_scratch(const engine::Context& context, Dressed& dressed, const Arguments& arguments) {
  double worst = 0.0;
  for (int i = 1; i <= arguments.judged; ++i) {
    const double by_mm = arguments.girth_mm * i / arguments.judged;
    dressed.reshape(1e-3 * by_mm);
    const int waited = dressed.wait_for(1e-3 * by_mm);
    const tryon::LiveBody& live = *dressed.session().body();
    const double carried_mm = error_mm(context, *live.skin, live.proxy);
    const tryon::PreparedBody scratch = bench::or_exit(tryon::fit_bound_proxy(context, *live.skin, {}));
    const double scratch_mm = error_mm(context, *live.skin, scratch.fit.proxy);
    std::printf("%5.1f mm wider: error %.3f mm, from scratch %.3f mm, ratio %.2f; after %d frames\n", by_mm,
                carried_mm, scratch_mm, carried_mm / scratch_mm, waited);
    worst = std::max(worst, carried_mm / scratch_mm);
  }
  return worst;
}

void print_times(const char* what, const std::vector<double>& sorted) {
  const auto at = [&](double share) {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  };
  std::printf("%-44s median %.2f, 99 %% %.2f, most %.2f\n", what, at(0.5), at(0.99), sorted.back());
}

void print_bar(const char* what, double value, double bar) {
  std::printf("%-44s %8.2f  at most %6.2f%s\n", what, value, bar, value <= bar ? "" : "  MISSED");
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app{
      "A slider of girth swept while the body wears a skirt: frame times, and error beside a new fit."};
  app.add_option("--body", arguments.body, "a body file in place of the built-in one");
  app.add_option("--motion", arguments.motion, "the body moves: walk, run, dance, ...");
  app.add_option("--seconds", arguments.seconds, "time of the sweep")->capture_default_str();
  app.add_option("--girth-mm", arguments.girth_mm, "how far the skin moves outward at most")
      ->capture_default_str();
  app.add_option("--edge-mm", arguments.edge_mm, "edges of the skirt; 11 makes some 5,000 particles")
      ->capture_default_str();
  app.add_option("--threads", arguments.workers, "workers")->capture_default_str();
  app.add_option("--judged", arguments.judged, "shapes that are compared with fits from scratch")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  const auto workers = engine::make_tbb_executor(arguments.workers);
  const engine::Context context{.executor = workers.get()};
  Dressed dressed(context, arguments);
  std::vector<double> before_ms;
  for (int i = 0; i < kFramesBefore; ++i) before_ms.push_back(dressed.frame());
  int shapes = 0;
  std::vector<double> frame_ms = sweep(dressed, arguments, shapes);
  std::printf("%s, %d workers\n%zu particles, %zu frames, %d shapes came into use\n",
              bench::title(bench::find_origin()).c_str(), arguments.workers, dressed.session().vertices(),
              frame_ms.size(), shapes);
  const double ratio = worst_over_scratch(context, dressed, arguments);
  std::ranges::sort(frame_ms);
  std::ranges::sort(before_ms);
  print_times("frames before the sweep, ms", before_ms);
  print_times("frames of the sweep, ms", frame_ms);
  print_bar("longest frame, ms", frame_ms.back(), kMostFrame_ms);
  print_bar("error over that of fits from scratch", ratio, kMostOverScratch);
  print_bar("cloth finite (0: yes)", dressed.outcome().cloth.finite ? 0.0 : 1.0, 0.0);
  return 0;
}
