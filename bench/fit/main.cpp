// fit DATA_FOLDER [--tier T] [--count N]... [--body NAME]... [--threads N] [--seconds S]
// CSV: one line a (body, tier, count) with the fit's own report and the error of the signed distance at
// points within 30 mm of the skin.
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <bodice/engine/random.hpp>
#include <bodice/fitting/fit.hpp>

#include "near_skin.hpp"
#include "real_body.hpp"

namespace {

using namespace bodice;

struct Arguments {
  std::filesystem::path data;
  std::vector<proxy::Tier> tiers;
  std::vector<int> counts;
  std::vector<std::string> bodies;
  int threads = 2;
  double seconds = 2.0;
};

Arguments parse(int argc, char** argv) {
  Arguments a;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool has_value = i + 1 < argc;
    if (word == "--tier" && has_value) {
      if (const auto tier = proxy::tier_from_name(argv[++i])) a.tiers.push_back(*tier);
    } else if (word == "--count" && has_value) {
      a.counts.push_back(std::stoi(argv[++i]));
    } else if (word == "--body" && has_value) {
      a.bodies.emplace_back(argv[++i]);
    } else if (word == "--threads" && has_value) {
      a.threads = std::stoi(argv[++i]);
    } else if (word == "--seconds" && has_value) {
      a.seconds = std::stod(argv[++i]);
    } else {
      a.data = word;
    }
  }
  using proxy::Tier;
  if (a.tiers.empty()) a.tiers = {Tier::kPaper, Tier::kSolid, Tier::kTight, Tier::kRelief};
  if (a.counts.empty()) a.counts = {8, 16, 32, 55, 89, 200, 400};
  if (a.bodies.empty()) a.bodies = {"bodies/f_avg_rest"};
  return a;
}

double stage_ms(const fitting::FitResult& result, std::string_view name) {
  double ms = 0.0;
  for (const auto& stage : result.stages)
    if (stage.name == name) ms += stage.ms;
  return ms;
}

void print_line(const std::string& name, const fitting::FitResult& r, const fit_bench::NearSkin& near) {
  const auto& a = r.accuracy;
  std::printf(
      "%s,%s,%zu,%zu,%.1f,%.1f,%.1f,%.1f,%.3f,%.3f,%.2f,%.3f,%.3f,%.2f,%.3f,%.3f,%.3f,%.3f,%.2f,%d,%.2f,%."
      "2f\n",
      name.c_str(), std::string(proxy::name(r.proxy.tier())).c_str(), r.proxy.ellipsoids().size(),
      r.proxy.bytes(), stage_ms(r, "fit"), stage_ms(r, "tight"), stage_ms(r, "relief"),
      stage_ms(r, "measure"), 1e3 * a.gap_m.mean, 1e3 * a.gap_m.p95, 1e3 * a.gap_m.max,
      a.interior_covered_percent, a.skin_outside_percent, 1e3 * a.skin_outside_depth_m, near.mean_mm,
      near.p95_mm, near.missed_percent, near.false_percent, near.max_mm, near.deep_leaks, 1e3 * r.mu_torso_m,
      1e3 * r.mu_limbs_m);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = parse(argc, argv);
  const auto executor = engine::make_tbb_executor(arguments.threads);
  engine::Context context;
  context.executor = executor.get();
  std::printf(
      "body,tier,ellipsoids,bytes,fit_ms,tight_ms,relief_ms,measure_ms,gap_mean_mm,gap_p95_mm,gap_max_mm,"
      "interior_percent,uncovered_percent,uncovered_mm,near_mean_mm,near_p95_mm,missed_percent,false_percent,"
      "near_max_mm,deep_leaks,mu_torso_mm,mu_limbs_mm\n");
  for (const std::string& name : arguments.bodies) {
    const auto own_labels = arguments.data / (name + ".labels.txt");
    const auto body = fit_bench::load(
        arguments.data / (name + ".obj"),
        exists(own_labels) ? own_labels : arguments.data / "labels/makehuman13380.labels.txt");
    if (!body) {
      std::fprintf(stderr, "fit: cannot read %s and its labels\n", name.c_str());
      return 1;
    }
    const geometry::MeshDistance distance(context, body->mesh);
    const auto probes = fit_bench::near_skin_probes(context, body->mesh, distance);
    for (const proxy::Tier tier : arguments.tiers)
      for (const int count : arguments.counts) {
        fitting::FitOptions options;
        options.tier = tier;
        options.max_ellipsoids = count;
        options.time_budget_s = arguments.seconds;
        const fitting::LabelledSkin skin{body->mesh, body->part, body->stature_m, {}, &distance};
        const auto result = fitting::fit(context, skin, options);
        if (!result) {
          std::fprintf(stderr, "fit: %s\n", result.error().sentence().c_str());
          return 1;
        }
        print_line(name, *result, fit_bench::judge(context, result->proxy, probes));
      }
  }
  return 0;
}
