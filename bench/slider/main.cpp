// A slider makes the built-in body, or that of --body, wider and narrower again while it wears a skirt: how
// long do the frames take, and is the proxy of each shape as good as one that is fitted to it from scratch?
// The body stands, or moves with --motion. Bars: no frame above 8 ms with 5,000 particles and two workers,
// the error at most 1.2 times that of the fit from scratch.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>

#include <bodice/io/scene.hpp>
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
constexpr int kKeepOneOf = 10, kSheetColumns = 10;
constexpr int kFramesBefore = 120;  // what a frame takes on this machine without a slider

struct Arguments {
  std::string body, motion, sheet;
  double seconds = 5.0, girth_mm = 25.0, edge_mm = 11.0;
  int workers = 2, frame_workers = 0, judged = 4;
  std::size_t longest = 0;
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

/// What a frame took, and what happened in it.
struct FrameRecord {
  double frame_ms = 0.0;      ///< the time by the clock
  double processor_ms = 0.0;  ///< the time that the calling thread took of its processor
  double boundary_ms = 0.0, cloth_ms = 0.0, contact_ms = 0.0;
  bool new_shape = false, new_tables = false;
};

/// Processor time of the calling thread, which other programs do not change.
double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// A session with the skirt on, after its first second.
class Dressed {
 public:
  Dressed(const engine::Context& context, const Arguments& arguments) {
    tryon::SessionOptions options;
    options.moves = !arguments.motion.empty();
    options.pipeline.frame_workers = arguments.frame_workers;
    session_ = std::make_unique<tryon::Session>(context, options);
    tryon::BodySource source = synth::BodyOptions{};
    if (!arguments.body.empty()) source = tryon::BodyFile{arguments.body};
    if (options.moves) session_->play({.motion = arguments.motion, .clip = {}});
    bench::or_exit(session_->submit(source).wait());
    frame();
    skin_ = session_->body()->skin;
    normals_ = geometry::vertex_normals(skin_->input.skin);
    const auto garment =
        bench::or_exit(tryon::make_garment(context, *skin_, {.edge_length_m = 1e-3 * arguments.edge_mm}));
    cloth_ = {.name = "cloth", .mesh = garment.mesh, .frames = {}, .time_s = {}, .colors = {}};
    bench::or_exit(session_->dress({garment}));
    for (int i = 0; i < 60; ++i) frame();
  }

  /// Runs a frame at its time, as a program that draws does.
  FrameRecord frame() {
    const std::uint64_t before = outcome_.proxy_hash;
    const double begin_ms = processor_ms();
    const auto begin = std::chrono::steady_clock::now();
    outcome_ = session_->frame(kFrame_s);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    const double processor = processor_ms() - begin_ms;
    std::this_thread::sleep_until(begin + std::chrono::duration<double>(kFrame_s));
    return {took.count(),
            processor,
            1e-6 * static_cast<double>(outcome_.timing.boundary_ns),
            1e-3 * outcome_.cloth.frame_us,
            1e-3 * outcome_.cloth.collision_us,
            outcome_.proxy_hash != before,
            outcome_.took_refit};
  }
  void reshape(double by_m) { bench::or_exit(session_->reshape(widened(*skin_, normals_, by_m))); }
  /// Frames until the requested shape is in use.
  int wait_for(double by_m) {
    const std::vector<Vec3> wanted = widened(*skin_, normals_, by_m);
    int frames = 0;
    while (session_->body()->skin->input.skin.positions != wanted && ++frames < 1200) frame();
    return frames;
  }

  /// Keeps the frame for the contact sheet.
  void keep() {
    cloth_.frames.emplace_back(session_->vertices());
    session_->positions(cloth_.frames.back());
    cloth_.time_s.push_back(static_cast<double>(cloth_.frames.size()));
    bodies_.emplace_back(skin_->input.skin.positions.size());
    session_->skin_positions(bodies_.back());
  }
  void write_sheet(const std::string& png) const {
    io::Scene scene;
    scene.body = &skin_->input.skin;
    scene.body_frames = bodies_;
    scene.garments = {cloth_};
    std::vector<std::size_t> frames(bodies_.size());
    std::iota(frames.begin(), frames.end(), std::size_t{0});
    bench::or_exit(io::write_contact_sheet(scene, frames, kSheetColumns, png, {.width = 240, .height = 360}));
  }

  tryon::Session& session() { return *session_; }
  const tryon::FrameOutcome& outcome() const { return outcome_; }

 private:
  std::unique_ptr<tryon::Session> session_;
  std::shared_ptr<const tryon::SegmentedSkin> skin_;
  std::vector<Vec3> normals_;
  io::GarmentTrack cloth_;
  std::vector<std::vector<Vec3>> bodies_;
  tryon::FrameOutcome outcome_;
};

/// Mean error of a proxy within 30 mm of the skin at rest, millimeters.
double error_mm(const engine::Context& context, const tryon::SegmentedSkin& skin,
                const proxy::BodyProxy& proxy) {
  const collision::Collider collider(proxy);
  const auto found = tryon::measure_proxy_error(context, collider, skin.input.skin, *skin.distance, kNear_m);
  return 1e3 * found.error_m.mean;
}

/// Sweeps the slider there and back.
std::vector<FrameRecord> sweep(Dressed& dressed, const Arguments& arguments) {
  std::vector<FrameRecord> records;
  const int frames = static_cast<int>(std::lround(arguments.seconds / kFrame_s));
  for (int i = 0; i < frames; ++i) {
    const double share = 1.0 - std::abs(2.0 * (i + 1) / frames - 1.0);
    dressed.reshape(1e-3 * arguments.girth_mm * share);
    records.push_back(dressed.frame());
    if (!arguments.sheet.empty() && i % kKeepOneOf == 0) dressed.keep();
  }
  return records;
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

/// The longest frames, and what they spent their time on.
void print_longest(std::vector<FrameRecord> records, std::size_t count) {
  std::ranges::sort(records, std::greater<>(), &FrameRecord::frame_ms);
  records.resize(std::min(count, records.size()));
  for (const FrameRecord& r : records)
    std::printf(
        "  %6.2f ms, processor %.2f: boundary %.2f, cloth %.2f (body contact %.2f, all workers), rest "
        "%.2f%s%s\n",
        r.frame_ms, r.processor_ms, r.boundary_ms, r.cloth_ms, r.contact_ms,
        r.frame_ms - r.boundary_ms - r.cloth_ms, r.new_shape ? ", a new shape" : "",
        r.new_tables ? ", tables of a pose" : "");
}

void print_times(const char* what, const std::vector<FrameRecord>& records, double FrameRecord::*time) {
  if (records.empty()) return;
  std::vector<double> sorted;
  for (const FrameRecord& r : records) sorted.push_back(r.*time);
  std::ranges::sort(sorted);
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
  app.add_option("--frame-threads", arguments.frame_workers,
                 "threads of a frame; 0: all. With 1 its processor time is the work of the whole frame")
      ->capture_default_str();
  app.add_option("--sheet", arguments.sheet,
                 "write a contact sheet of every tenth frame of the sweep, a PNG");
  app.add_option("--longest", arguments.longest, "so many of the longest frames are printed in parts");
  CLI11_PARSE(app, argc, argv);

  const auto workers = engine::make_tbb_executor(arguments.workers);
  const engine::Context context{.executor = workers.get()};
  Dressed dressed(context, arguments);
  std::vector<FrameRecord> before;
  for (int i = 0; i < kFramesBefore; ++i) before.push_back(dressed.frame());
  const std::vector<FrameRecord> records = sweep(dressed, arguments);
  std::vector<FrameRecord> with_shapes;
  std::ranges::copy_if(records, std::back_inserter(with_shapes), &FrameRecord::new_shape);
  std::printf("%s, %d workers\n%zu particles, %zu frames, %zu shapes came into use\n",
              bench::title(bench::find_origin()).c_str(), arguments.workers, dressed.session().vertices(),
              records.size(), with_shapes.size());
  if (!arguments.sheet.empty()) dressed.write_sheet(arguments.sheet);
  const double ratio = arguments.judged > 0 ? worst_over_scratch(context, dressed, arguments) : 0.0;
  print_times("frames before the sweep, ms", before, &FrameRecord::frame_ms);
  print_times("frames of the sweep, ms", records, &FrameRecord::frame_ms);
  print_times("of these, frames with a new shape, ms", with_shapes, &FrameRecord::frame_ms);
  print_times("the same by the calling thread's processor", before, &FrameRecord::processor_ms);
  print_times("", records, &FrameRecord::processor_ms);
  print_times("", with_shapes, &FrameRecord::processor_ms);
  print_longest(records, arguments.longest);
  print_bar("longest frame, ms", std::ranges::max(records, {}, &FrameRecord::frame_ms).frame_ms,
            kMostFrame_ms);
  if (arguments.judged > 0) print_bar("error over that of fits from scratch", ratio, kMostOverScratch);
  print_bar("cloth finite (0: yes)", dressed.outcome().cloth.finite ? 0.0 : 1.0, 0.0);
  return 0;
}
