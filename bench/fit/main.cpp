// fit [DATA_FOLDER] [--tier T]... [--count N]... [--body NAME]... [--synth SEED]... [--svg FILE] [--threads
// N]
//     [--seconds S]
// fit ... --target MM... | --budget US...    what was asked for beside what was achieved
// fit ... --bars                         every tier at 89 ellipsoids beside what it promises, the worst body;
//                                        fails if a bar is missed
// fit ... --laws                         the constants of the dial, from the fits of --tier and --count
// fit ... --anytime                      error against time of what the anytime tiers publish
// fit --growth                           time against the number of vertices, a row a tier
// CSV: one line a (body, tier, count) with the fit's own report, the error of the signed distance at points
// within 30 mm of the skin, and what a query costs.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <bodice/fitting/fit.hpp>

#include <bench_references/near_skin.hpp>
#include "anytime.hpp"
#include "bars.hpp"
#include "front_svg.hpp"
#include "growth.hpp"
#include "laws.hpp"
#include "query_cost.hpp"
#include "real_body.hpp"

namespace {

using namespace bodice;

struct Arguments {
  std::filesystem::path data;
  std::vector<proxy::Tier> tiers;
  std::vector<int> counts;
  std::vector<std::string> bodies;
  std::vector<int> seeds;
  std::vector<double> targets_mm, budgets_us;
  std::filesystem::path svg;
  int threads = 2;
  double seconds = 2.0;
  bool bars = false, laws = false, growth = false, anytime = false;
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
    } else if (word == "--synth" && has_value) {
      a.seeds.push_back(std::stoi(argv[++i]));
    } else if (word == "--target" && has_value) {
      a.targets_mm.push_back(std::stod(argv[++i]));
    } else if (word == "--budget" && has_value) {
      a.budgets_us.push_back(std::stod(argv[++i]));
    } else if (word == "--svg" && has_value) {
      a.svg = argv[++i];
    } else if (word == "--bars") {
      a.bars = true;
    } else if (word == "--laws") {
      a.laws = true;
    } else if (word == "--anytime") {
      a.anytime = true;
    } else if (word == "--growth") {
      a.growth = true;
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
  if (a.bodies.empty() && a.seeds.empty()) a.seeds = {1};
  return a;
}

using fit_bench::stage_ms;

void print_line(const std::string& name, const fitting::FitResult& r, const bench::NearSkin& near,
                double query_ns) {
  const auto& a = r.accuracy;
  std::printf(
      "%s,%s,%zu,%zu,%.1f,%.1f,%.1f,%.1f,%.3f,%.3f,%.2f,%.3f,%.3f,%.2f,%.3f,%.3f,%.3f,%.3f,%.2f,%d,%.2f,%."
      "2f,%.1f\n",
      name.c_str(), std::string(proxy::name(r.proxy.tier())).c_str(), r.proxy.ellipsoids().size(),
      r.proxy.bytes(), stage_ms(r, "fit"), stage_ms(r, "tight"), stage_ms(r, "relief"),
      stage_ms(r, "measure"), 1e3 * a.gap_m.mean, 1e3 * a.gap_m.p95, 1e3 * a.gap_m.max,
      a.interior_covered_percent, a.skin_outside_percent, 1e3 * a.skin_outside_depth_m, near.mean_mm,
      near.p95_mm, near.missed_percent, near.false_percent, near.max_mm, near.deep_leaks, 1e3 * r.mu_torso_m,
      1e3 * r.mu_limbs_m, query_ns);
  std::fflush(stdout);
}

struct Subject {
  std::string name;
  fit_bench::LabeledBody body;
  geometry::MeshDistance distance;
  std::vector<bench::Probe> probes;

  Subject(const engine::Context& context, std::string called, fit_bench::LabeledBody made)
      : name(std::move(called)),
        body(std::move(made)),
        distance(context, body.mesh),
        probes(bench::near_skin_probes(context, body.mesh, distance)) {}

  fitting::LabeledSkin skin() const { return {body.mesh, body.part, body.stature_m, {}, &distance}; }
};

/// Calls `each` with every body asked for, one at a time; false if one cannot be had.
bool for_each_subject(const engine::Context& context, const Arguments& arguments,
                      const std::function<bool(const Subject&)>& each) {
  const auto& data = arguments.data;
  for (const std::string& name : arguments.bodies) {
    const auto own_labels = data / (name + ".labels.txt");
    auto body = fit_bench::load(data / (name + ".obj"),
                                exists(own_labels) ? own_labels : data / "labels/makehuman13380.labels.txt");
    if (!body) {
      std::fprintf(stderr, "fit: cannot read %s and its labels\n", name.c_str());
      return false;
    }
    if (!each(Subject(context, name, std::move(*body)))) return false;
  }
  for (const int seed : arguments.seeds) {
    auto body = fit_bench::make_synthetic(static_cast<std::uint64_t>(seed));
    if (!body || !each(Subject(context, "synth_" + std::to_string(seed), std::move(*body)))) return false;
  }
  return true;
}

std::optional<fitting::FitResult> fitted(const engine::Context& context, const Subject& subject,
                                         const fitting::FitOptions& options) {
  auto result = fitting::fit(context, subject.skin(), options);
  if (result) return std::move(*result);
  std::fprintf(stderr, "fit: %s\n", result.error().sentence().c_str());
  return std::nullopt;
}

/// Fits every subject with every tier and count asked for; false if one fails.
bool for_each_fit(const engine::Context& context, const Arguments& arguments,
                  const std::function<void(const Subject&, int, const fitting::FitResult&)>& take) {
  return for_each_subject(context, arguments, [&](const Subject& subject) {
    for (const proxy::Tier tier : arguments.tiers)
      for (const int count : arguments.counts) {
        fitting::FitOptions options;
        options.tier = tier;
        options.max_ellipsoids = count;
        options.time_budget_s = arguments.seconds;
        const auto result = fitted(context, subject, options);
        if (!result) return false;
        take(subject, count, *result);
      }
    return true;
  });
}

bool laws(const engine::Context& context, const Arguments& arguments) {
  std::vector<fit_bench::LawPoint> points;
  const auto note = [&](const Subject& subject, int, const fitting::FitResult& result) {
    points.push_back({std::string(proxy::name(result.proxy.tier())),
                      static_cast<double>(result.proxy.ellipsoids().size()),
                      result.accuracy.gap_m.mean / subject.body.stature_m});
  };
  const bool all = for_each_fit(context, arguments, note);
  fit_bench::print_laws(points);
  return all;
}

bool anytime(const engine::Context& context, const Arguments& arguments) {
  std::printf("body,ms,near_mean_mm\n");
  return for_each_subject(context, arguments, [&](const Subject& subject) {
    for (const proxy::Tier tier : arguments.tiers)
      if (!fit_bench::print_anytime(context, subject.name, subject.skin(), subject.probes, tier))
        return false;
    return true;
  });
}

bool front(const engine::Context& context, const Arguments& arguments) {
  std::printf(
      "body,tier,ellipsoids,bytes,fit_ms,tight_ms,relief_ms,measure_ms,gap_mean_mm,gap_p95_mm,gap_max_mm,"
      "interior_percent,uncovered_percent,uncovered_mm,near_mean_mm,near_p95_mm,missed_percent,false_percent,"
      "near_max_mm,deep_leaks,mu_torso_mm,mu_limbs_mm,query_ns\n");
  std::vector<fit_bench::FrontPoint> points;
  const auto judge = [&](const Subject& subject, int count, const fitting::FitResult& result) {
    const auto near = bench::judge(context, result.proxy, subject.probes);
    print_line(subject.name, result, near, fit_bench::query_ns(result.proxy, subject.body.mesh));
    points.push_back(
        {std::string(proxy::name(result.proxy.tier())), static_cast<double>(count), near.mean_mm});
  };
  const bool all = for_each_fit(context, arguments, judge);
  return all && (arguments.svg.empty() || fit_bench::write_front_svg(arguments.svg, points));
}

/// One line a (body, number asked for); the last line says how many were met within a fifth.
bool dial(const engine::Context& context, const Arguments& arguments) {
  std::printf("body,target_mm,achieved_mm,ratio,budget_us,measured_us,tier,ellipsoids,bytes,total_ms\n");
  int asked = 0, met = 0;
  const auto run = [&](const Subject& subject, std::optional<double> target_mm,
                       std::optional<double> budget_us) {
    fitting::FitOptions options;
    if (target_mm) options.target_error_m = 1e-3 * *target_mm;
    options.budget_us = budget_us;
    const auto r = fitted(context, subject, options);
    if (!r) return false;
    double total_ms = 0.0;
    for (const auto& stage : r->stages) total_ms += stage.ms;
    const double achieved = 1e3 * r->accuracy.gap_m.mean;
    const double us = 10.0 * fit_bench::query_ns(r->proxy, subject.body.mesh);
    const double ratio = target_mm ? achieved / *target_mm : us / budget_us.value_or(us);
    ++asked;
    met += target_mm ? ratio <= 1.2 && ratio >= 1.0 / 1.2 : ratio <= 1.2;
    std::printf("%s,%.3g,%.3f,%.3f,%.4g,%.1f,%s,%zu,%zu,%.0f\n", subject.name.c_str(),
                target_mm.value_or(0.0), achieved, ratio, budget_us.value_or(0.0), us,
                std::string(proxy::name(r->proxy.tier())).c_str(), r->proxy.ellipsoids().size(),
                r->proxy.bytes(), total_ms);
    std::fflush(stdout);
    return true;
  };
  const bool all = for_each_subject(context, arguments, [&](const Subject& subject) {
    for (const double mm : arguments.targets_mm)
      if (!run(subject, mm, std::nullopt)) return false;
    for (const double us : arguments.budgets_us)
      if (!run(subject, std::nullopt, us)) return false;
    return true;
  });
  std::printf("# met %d of %d (bar: all, within a fifth)\n", met, asked);
  return all;
}

/// Of the stage that makes the tier: the median of a few fits where a fit is too short for one to tell.
double time_of(const engine::Context& context, const Subject& subject, fitting::FitOptions options,
               const fitting::FitResult& result) {
  using proxy::Tier;
  constexpr int kRepeats = 9;
  if (options.tier == Tier::kRelief) return stage_ms(result, "relief");
  if (options.tier == Tier::kTight) return stage_ms(result, "tight");
  options.measure_accuracy = false;
  std::vector<double> ms{stage_ms(result, "fit")};
  for (int i = 1; i < kRepeats; ++i)
    if (const auto again = fitted(context, subject, options)) ms.push_back(stage_ms(*again, "fit"));
  const auto middle = ms.begin() + static_cast<std::ptrdiff_t>(ms.size() / 2);
  std::ranges::nth_element(ms, middle);
  return *middle;
}

bool bars(const engine::Context& context, const Arguments& arguments) {
  fit_bench::Bars table;
  const bool all = for_each_subject(context, arguments, [&](const Subject& subject) {
    for (const char* const kind : {"paper", "solid", "tight", "covering", "relief"}) {
      fitting::FitOptions options;
      options.covering = kind == std::string("covering");
      options.tier = options.covering ? proxy::Tier::kTight : *proxy::tier_from_name(kind);
      options.max_ellipsoids = 89;
      const auto result = fitted(context, subject, options);
      if (!result) return false;
      table.note(subject.name, kind, *result, bench::judge(context, result->proxy, subject.probes),
                 time_of(context, subject, options, *result), subject.body.mesh.positions.size());
    }
    return true;
  });
  table.print();
  if (table.missed() > 0) std::fprintf(stderr, "fit: %d bars are missed\n", table.missed());
  return all && table.missed() == 0;
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = parse(argc, argv);
  const auto executor = engine::make_tbb_executor(arguments.threads);
  engine::Context context;
  context.executor = executor.get();
  if (arguments.bars) return bars(context, arguments) ? 0 : 1;
  if (arguments.laws) return laws(context, arguments) ? 0 : 1;
  if (arguments.anytime) return anytime(context, arguments) ? 0 : 1;
  if (arguments.growth) return fit_bench::print_growth(context) ? 0 : 1;
  const bool asks = !arguments.targets_mm.empty() || !arguments.budgets_us.empty();
  return (asks ? dial(context, arguments) : front(context, arguments)) ? 0 : 1;
}
