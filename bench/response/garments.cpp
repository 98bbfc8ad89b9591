// No frame may be slow and no garment torn, however it is pinched: every garment on its body, frame by frame.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include <bodice/tryon/drape.hpp>
#include <bodice/tryon/wearing.hpp>

#include "modes.hpp"

namespace bench {

namespace fs = std::filesystem;
using namespace bodice;

namespace {

constexpr double kSlowest = 4.0;  // a frame, in medians

double cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// Frame times of one drape, and the extremes of its report.
struct Outcome {
  std::vector<double> frame_ms;
  collision::ContactReport contacts;
  double stretch_max = 0.0, speed_max_m_s = 0.0;
  bool finite = true;

  double at(double q) const { return frame_ms[static_cast<std::size_t>(q * double(frame_ms.size() - 1))]; }
};

template <class T>
T must(engine::Result<T> result) {
  if (result) return std::move(result).value();
  std::puts(result.error().sentence().c_str());
  std::exit(1);
}

tryon::PreparedBody prepare(const fs::path& file, proxy::Tier tier) {
  auto skin = must(tryon::segment_file({}, file, {}));
  return must(tryon::fit_proxy({}, std::move(skin), {.tier = tier}));
}

Outcome drape(const tryon::PreparedBody& body, const fs::path& file, int frames, bool each) {
  auto garment = must(io::import_garment({}, file, body.skin.input.frame));
  const tryon::WornGarment worn{file.string(), garment.skin, tryon::held_vertices(garment.skin, body.skin)};
  const tryon::Wardrobe all = tryon::join({worn}).value();
  const proxy::BodyProxy& proxy = body.fit.proxy;
  cloth::SolverOptions options{.substeps = 16};
  if (proxy.tier() == proxy::Tier::kPaper) options.response = collision::Response::kPaper;
  const collision::Collider collider(proxy);
  options.thickness_m = tryon::known_thickness_m({}, all.mesh, *body.skin.distance, collider);
  auto solver = must(cloth::Solver::make(all.mesh, all.held, must(cloth::find_fabric("cotton")), options));
  solver.move_pins(tryon::held_positions(all, collider, options.thickness_m));
  Outcome outcome;
  for (int frame = 1; frame <= frames; ++frame) {
    const double start = cpu_ms();
    const cloth::FrameReport report = solver.step({}, collider, 1.0 / 60.0);
    outcome.frame_ms.push_back(cpu_ms() - start);
    outcome.contacts.add(report.contacts);
    outcome.stretch_max = std::max(outcome.stretch_max, report.stretch_max);
    outcome.finite = outcome.finite && report.finite;
    if (!each) continue;
    std::printf(
        "%4d %8.1f ms %6d substeps %9llu contacts %6llu pinched %6llu pending %6llu exactly %6llu fallbacks "
        "%6llu wrong side %5llu unresolved "
        "stretch %.3f (95 %% %.3f) energy %.3f J deepest %.2f mm\n",
        frame, outcome.frame_ms.back(), report.substeps,
        static_cast<unsigned long long>(report.contacts.contacts),
        static_cast<unsigned long long>(report.contacts.pinched),
        static_cast<unsigned long long>(report.contacts.pending),
        static_cast<unsigned long long>(report.contacts.judged_exactly),
        static_cast<unsigned long long>(report.contacts.fallbacks),
        static_cast<unsigned long long>(report.contacts.wrong_side),
        static_cast<unsigned long long>(report.contacts.unresolved), report.stretch_max, report.stretch_p95,
        report.kinetic_energy_j, 1e3 * double{report.contacts.deepest_m});
  }
  std::sort(outcome.frame_ms.begin(), outcome.frame_ms.end());
  return outcome;
}

std::string body_of(const fs::path& garment) {
  const std::string stem = garment.stem().string();
  return stem.substr(stem.find("__") + 2) + ".obj";
}

}  // namespace

bool drape_garments(std::span<char*> arguments) {
  const fs::path data = arguments[0];
  const auto tier = proxy::tier_from_name(arguments.size() > 1 ? arguments[1] : "relief");
  const int frames = arguments.size() > 2 ? std::max(1, std::atoi(arguments[2])) : 60;
  const std::string only = arguments.size() > 3 ? arguments[3] : "";
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(data / "garments"))
    if (entry.path().extension() == ".obj" && entry.path().string().find(only) != std::string::npos)
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::printf(
      "| garment | median ms | p99 | max | contacts | pinched | pending | exactly | fallbacks | wrong side | "
      "unresolved | stretch |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  bool good = tier.has_value();
  for (std::size_t i = 0; good && i < files.size(); ++i) {
    const auto body = prepare(data / "bodies" / body_of(files[i]), *tier);
    const Outcome o = drape(body, files[i], frames, files.size() == 1);
    const bool holds = o.finite && o.at(0.99) < kSlowest * o.at(0.5) && o.contacts.unresolved == 0;
    std::printf("| %s | %.2f | %.2f | %.2f | %llu | %llu | %llu | %llu | %llu | %llu | %llu | %.3f | %s\n",
                files[i].stem().c_str(), o.at(0.5), o.at(0.99), o.frame_ms.back(),
                static_cast<unsigned long long>(o.contacts.contacts),
                static_cast<unsigned long long>(o.contacts.pinched),
                static_cast<unsigned long long>(o.contacts.pending),
                static_cast<unsigned long long>(o.contacts.judged_exactly),
                static_cast<unsigned long long>(o.contacts.fallbacks),
                static_cast<unsigned long long>(o.contacts.wrong_side),
                static_cast<unsigned long long>(o.contacts.unresolved), o.stretch_max,
                holds ? "holds" : "DOES NOT HOLD");
    std::fflush(stdout);
    good = good && o.finite;
  }
  return good;
}

}  // namespace bench
