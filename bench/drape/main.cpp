// How does every garment of the data folder drape on its body? Each one hangs for 300 frames of gusty wind
// and 300 calm ones; the bars are printed over the columns. --substeps 2,4,8,16,32 shows how the result
// improves with substeps, --halve compares outlines of two resolutions, --turn 90 turns the bodies.
// --motion walk,run,dance instead lets two bodies each move in a skirt, a T-shirt and a bodysuit, and then
// stand. --faces judges whole triangles by the exact skin, on bodies that stand and that walk.
#include <cstdio>
#include <map>

#include <CLI/CLI.hpp>

#include "faces.hpp"
#include "moving.hpp"
#include "sheet.hpp"
#include "silhouette.hpp"
#include "wear.hpp"

namespace {

// Bars, in the units of the columns. The bar on stretch is that of tryon's default fabric and substeps.
constexpr double kSettledDeepest_mm = 3.0, kEndDeepest_mm = 1.0, kStretchP95_percent = 5.0,
                 kRestSpeed_mm_s = 1.0, kOutlines_percent = 2.0;

constexpr double kRadians = 0.017453292519943295;  // a degree

std::string missed_bars(const bench::Wear& w) {
  std::string missed;
  auto judge = [&](const char* name, double value, double bar) {
    if (!(value <= bar)) missed += std::string(missed.empty() ? "  MISSED " : ", ") + name;
  };
  judge("deep", 1e3 * w.settled_deepest_m, kSettledDeepest_mm);
  judge("deep at the end", 1e3 * w.end_deepest_m, kEndDeepest_mm);
  judge("stretch", 1e2 * w.stretch_p95, kStretchP95_percent);
  judge("rest", 1e3 * w.rest_speed_m_s, kRestSpeed_mm_s);
  return missed + (w.finite ? "" : "  NOT FINITE");
}

void print_head() {
  std::printf("%-34s %6s %5s %7s %7s %7s %7s %7s %7s %7s %8s %8s %6s %6s\n", "", "parti-", "", "ms", "ms",
              "mm deep", "mm deep", "pierced", "stretch", "stretch", "mm/s", "mm/s", "asleep", "drop");
  std::printf("%-34s %6s %5s %7s %7s %7s %7s %7s %7s %7s %8s %8s %6s %6s\n", "garment", "cles", "held",
              "median", "p99", "fr > 10", "end", "%", "p95 %", "max %", "windy", "rest", "%", "mm");
  std::printf("%-34s %6s %5s %7s %7s %7.0f %7.0f %7s %7.0f %7s %8s %8.0f %6s %6s\n", "  at most", "", "", "",
              "", kSettledDeepest_mm, kEndDeepest_mm, "", kStretchP95_percent, "", "", kRestSpeed_mm_s, "",
              "");
}

void print_row(const std::string& name, const bench::Wear& w) {
  std::printf("%-34s %6zu %5zu %7.2f %7.2f %7.2f %7.2f %7.2f %7.2f %7.1f %8.2f %8.3f %6.1f %6.0f%s\n",
              name.c_str(), w.particles, w.held, w.frame_ms_median, w.frame_ms_p99, 1e3 * w.settled_deepest_m,
              1e3 * w.end_deepest_m, 1e2 * w.pierced_share, 1e2 * w.stretch_p95, 1e2 * w.stretch_max,
              1e3 * w.windy_speed_m_s, 1e3 * w.rest_speed_m_s,
              1e2 * static_cast<double>(w.asleep) / static_cast<double>(w.particles), 1e3 * w.drop_m,
              missed_bars(w).c_str());
  std::fflush(stdout);
}

/// A garment at the end of its windy frames.
struct Hung {
  bodice::geometry::TriMesh mesh;
  double stature_m = 0.0;
};

/// Compares the outlines of NAME_fine__BODY and NAME__BODY.
void print_outlines(const std::map<std::string, Hung>& hung) {
  for (const auto& [name, fine] : hung) {
    const std::size_t at = name.find("_fine__");
    if (at == std::string::npos) continue;
    const auto coarse = hung.find(name.substr(0, at) + name.substr(at + 5));
    if (coarse == hung.end()) continue;
    const double apart_m = bench::outline_difference_m(coarse->second.mesh, fine.mesh);
    const double percent = 1e2 * apart_m / fine.stature_m;
    std::printf("%s, outline against half the resolution: %.1f mm, %.2f %% of stature (at most %.0f)%s\n",
                name.c_str(), 1e3 * apart_m, percent, kOutlines_percent,
                percent <= kOutlines_percent ? "" : "  MISSED");
  }
}

/// The command line, with its defaults.
struct Arguments {
  std::string data = "../shared/data", only, cache, picture, fabric = "cotton", tier = "relief";
  std::vector<double> wind = {0.0, 0.0, 2.0};
  std::vector<int> substeps = {bodice::tryon::DrapeOptions{}.solver.substeps};
  int workers = 2;
  double turn_deg_s = 0.0;
  bool also_halved = false;
  std::vector<std::string> motions;
  double seconds = 10.0;
  std::string out;
  bool repeat = false;
  bool faces = false, causes = false, walking_only = false;
  int starts = 1;
  double certify_mm = 0.0, tighter_mm = 0.0;
  bench::WearOptions wear = {.solver = bodice::tryon::DrapeOptions{}.solver};
};

void add_options(CLI::App& app, Arguments& a) {
  app.add_option("--data", a.data,
                 "folder with garments/ and bodies/ (with --motion: absent, bodies are made)");
  app.add_option("--only", a.only, "only garments with this text in their names");
  app.add_option("--cache", a.cache, "folder that keeps the proxies from run to run");
  app.add_option("--sheet", a.picture, "write a contact sheet, a PNG");
  app.add_option("--fabric", a.fabric, "the fabric of all garments");
  app.add_option("--tier", a.tier, "the tier of all proxies");
  app.add_option("--frames", a.wear.windy_frames, "frames with wind");
  app.add_option("--calm", a.wear.calm_frames, "frames without wind, after them");
  app.add_option("--substeps", a.substeps, "numbers of substeps, a row for each")->delimiter(',');
  app.add_option("--iterations", a.wear.solver.iterations, "sweeps a substep");
  app.add_option("--wind", a.wind, "wind, meters a second")->expected(3)->delimiter(',');
  app.add_option("--gust", a.wear.solver.environment.gust, "strength of gusts, a share of the wind");
  app.add_option("--threads", a.workers, "workers");
  app.add_option("--turn", a.turn_deg_s, "turns the body, degrees a second");
  app.add_flag("--halve", a.also_halved, "each garment again with its edges halved");
  auto* motion = app.add_option("--motion", a.motions, "bodies move: walk, run, dance, ...")->delimiter(',');
  app.add_option("--seconds", a.seconds, "time in motion, before two seconds at rest")
      ->check(CLI::Range(0.1, 600.0))
      ->needs(motion);
  app.add_option("--out", a.out, "folder for contact sheets of every tenth frame, and the depths of all")
      ->needs(motion);
  app.add_flag("--repeat", a.repeat, "again with 1, 2, 3 and 7 workers, to compare hashes")->needs(motion);
  auto* faces =
      app.add_flag("--faces", a.faces, "judges whole triangles, on a body that stands and one that walks")
          ->excludes(motion);
  app.add_flag("--causes", a.causes, "why cloth lies inside the skin in the worst frame of a walk")
      ->needs(faces);
  app.add_option("--tighter-mm", a.tighter_mm, "garments are first moved so much nearer to the skin")
      ->needs(faces);
  app.add_flag("--walking", a.walking_only, "no body that stands")->needs(faces);
  app.add_option("--starts", a.starts, "walks of each garment, with starts that differ by rounding")
      ->check(CLI::Range(1, 100))
      ->needs(faces);
  app.add_option("--certify-mm", a.certify_mm,
                 "depth in the proxy that no point may exceed, proved each frame")
      ->needs(faces);
  app.add_flag("--trace", a.wear.trace, "a line every thirty frames");
}

/// Drapes every garment; false if the contact sheet cannot be written.
bool drape_all(Arguments a) {
  using namespace bodice;
  a.wear.solver.environment.wind_m_s = {a.wind[0], a.wind[1], a.wind[2]};
  a.wear.fabric = cloth::find_fabric(a.fabric).value();
  a.wear.turn_rad_s = a.turn_deg_s * kRadians;
  const auto executor = engine::make_tbb_executor(a.workers);
  const engine::Context context{.executor = executor.get()};
  bench::Sheet sheet;
  std::map<std::string, Hung> hung;
  print_head();
  for (const bench::Outfit& outfit : bench::find_outfits(a.data, a.only, a.also_halved)) {
    const bench::Body body =
        bench::load_body(context, outfit.body, proxy::tier_from_name(a.tier).value(), a.cache);
    const tryon::WornGarment garment = bench::load_garment(context, outfit, body);
    bench::Wear worn;
    for (const int count : a.substeps) {
      a.wear.solver.substeps = count;
      worn = bench::wear(context, body, garment, a.wear);
      print_row(a.substeps.size() > 1 ? std::to_string(count) + " " + outfit.name : outfit.name, worn);
      if (a.turn_deg_s != 0.0) std::printf("  behind its body by %.2f degrees\n", worn.behind_rad / kRadians);
    }
    sheet.add(body.skin.input.skin.positions, body.skin.input.skin.triangles, garment, worn.end);
    hung[outfit.name] = {{worn.end, garment.mesh.triangles}, body.proxy.stature_m()};
  }
  print_outlines(hung);
  return a.picture.empty() || sheet.write(a.picture);
}

/// The bodies move. Without --data they are made.
bool drape_in_motion(const Arguments& a, bool has_data) {
  const auto executor = bodice::engine::make_tbb_executor(a.workers);
  bench::MovingOptions options;
  if (has_data) options.data = a.data;
  options.only = a.only;
  options.motions = a.motions;
  options.out = a.out;
  options.run.moving_s = a.seconds;
  options.run.repeat = a.repeat;
  options.run.drape.solver = a.wear.solver;
  options.run.drape.solver.environment = {};
  options.run.drape.solver.substeps = a.substeps.front();
  options.run.drape.fabric = bodice::cloth::find_fabric(a.fabric).value();
  return bench::drape_moving({.executor = executor.get()}, options);
}

bool judge_all_faces(const Arguments& a) {
  const auto executor = bodice::engine::make_tbb_executor(a.workers);
  bench::FacesOptions options{.data = a.data, .only = a.only, .cache = a.cache, .sheet = a.picture};
  options.tighter_m = 1e-3 * a.tighter_mm;
  options.causes = a.causes, options.walking_only = a.walking_only, options.starts = a.starts;
  options.drape.solver.substeps = a.substeps.front();
  options.drape.solver.iterations = a.wear.solver.iterations;
  options.drape.fabric = bodice::cloth::find_fabric(a.fabric).value();
  if (a.certify_mm > 0.0) options.drape.solver.certify_m = 1e-3 * a.certify_mm;
  return bench::judge_faces({.executor = executor.get()}, options);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  arguments.wear.solver.environment.gust = 0.3;
  CLI::App app("Every garment of the data folder on its body");
  add_options(app, arguments);
  CLI11_PARSE(app, argc, argv);
  const bool done = arguments.faces             ? judge_all_faces(arguments)
                    : arguments.motions.empty() ? drape_all(arguments)
                                                : drape_in_motion(arguments, app.count("--data") > 0);
  if (done) return 0;
  std::fprintf(stderr, "could not write %s\n",
               (arguments.motions.empty() ? arguments.picture : arguments.out).c_str());
  return 1;
}
