#include "bars.hpp"

#include <algorithm>
#include <cstdio>

#include "questions.hpp"

namespace fit_bench {

void Bars::at_most(const std::string& kind, const std::string& measure, double bar, double value,
                   const std::string& body) {
  Line& line = lines_[{kind, measure}];
  if (line.bodies == 0 || value > line.worst) line.worst = value, line.worst_body = body;
  line.bar = bar;
  line.sum += value;
  line.missed += value > bar;
  ++line.bodies;
}

void Bars::note(const std::string& body, const std::string& kind, const bodice::fitting::FitResult& result,
                const bench::NearSkin& near, double ms, std::size_t vertices) {
  const auto& a = result.accuracy;
  const double timed_ms = ms * std::min(1.0, kTimedVertices / static_cast<double>(vertices));
  const auto add = [&](const char* measure, double bar, double value) {
    at_most(kind, measure, bar, value, body);
  };
  add("ellipsoids", 89, static_cast<double>(result.proxy.ellipsoids().size()));
  if (kind == "relief") {
    add("near mean mm", 0.40, near.mean_mm);
    add("near p95 mm", 1.3, near.p95_mm);
    add("missed %", 0.15, near.missed_percent);
    add("false %", 0.2, near.false_percent);
    add("deep leaks", 0, near.deep_leaks);
    add("KB", 128, static_cast<double>(result.proxy.bytes()) / 1024.0);
    add("ms on top of tight", 1000, timed_ms);
  } else if (kind == "tight") {
    add("near mean mm", 1.3, near.mean_mm);
    add("near p95 mm", 4.0, near.p95_mm);
    add("ms", 1000, timed_ms);
  } else if (kind == "covering") {
    add("uncovered %", 0.1, a.skin_outside_percent);
    add("uncovered mm", 0.5, 1e3 * a.skin_outside_depth_m);
    add("gap mean mm", 5.0, 1e3 * a.gap_m.mean);
  } else {
    add("ms", 15, timed_ms);
    if (kind == "paper") return;
    add("uncovered %", 0.0, a.skin_outside_percent);
    add("interior outside %", 0.0, 100.0 - a.interior_covered_percent);
    add("gap mean mm", 14.0, 1e3 * a.gap_m.mean);
  }
}

void Bars::print() const {
  std::printf("kind,measure,bar,mean,worst,worst_body,misses,bodies\n");
  for (const auto& [key, line] : lines_)
    std::printf("%s,%s,%.3g,%.3f,%.3f,%s,%d,%d\n", key.first.c_str(), key.second.c_str(), line.bar,
                line.sum / line.bodies, line.worst, line.worst_body.c_str(), line.missed, line.bodies);
}

int Bars::missed() const {
  return static_cast<int>(
      std::ranges::count_if(lines_, [](const auto& entry) { return entry.second.missed > 0; }));
}

namespace {

using namespace bodice;

/// The time of the stage that makes the tier, ms: the median of several fits for tiers that take few
/// milliseconds.
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

}  // namespace

bool print_bars(const engine::Context& context, const Arguments& arguments) {
  Bars table;
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

}  // namespace fit_bench
