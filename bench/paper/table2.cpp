#include "table2.hpp"

#include <algorithm>
#include <cstdio>

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/fitting/fit.hpp>

#include "cpu_clock.hpp"
#include "stand_in.hpp"

namespace paper_bench {
namespace {

using namespace bodice;

constexpr double kLeastRadius = 3e-4;  // least radius as a share of stature, as in bodice::fitting

std::vector<geometry::Ellipsoid> shapes_of(const proxy::BodyProxy& proxy) {
  std::vector<geometry::Ellipsoid> shapes;
  for (const auto& e : proxy.ellipsoids()) shapes.push_back(e.shape);
  return shapes;
}

double fit_stage_ms(const fitting::FitResult& fit) {
  double ms = 0.0;
  for (const auto& stage : fit.stages)
    if (stage.name == "fit") ms += stage.ms;
  return ms;
}

engine::Result<MethodResult> measure_ours(const Subject& subject, const Judge& judge, int repeats) {
  const CpuClock clock;
  engine::Context context;
  context.clock = &clock;
  const auto profile = body::find_profile("gb10000-88");
  if (!profile) return profile.error();
  MethodResult result{.method = "the paper's, here", .segment_ms = 1e30, .fit_ms = 1e30};
  for (int r = 0; r < repeats; ++r) {
    const std::int64_t begin_ns = clock.now_ns();
    const auto anatomy = anatomy::analyze(context, subject.mesh, {.profile = *profile});
    if (!anatomy) return anatomy.error();
    result.segment_ms = std::min(result.segment_ms, clock.ms_since(begin_ns));
    const auto fit =
        fitting::fit(context, {subject.mesh, anatomy->part, anatomy->stature_m, {}, &judge.distance()},
                     {.tier = proxy::Tier::kPaper, .max_ellipsoids = subject.paper.ellipsoids});
    if (!fit) return fit.error();
    result.fit_ms = std::min(result.fit_ms, fit_stage_ms(*fit));
    if (r > 0) continue;
    result.ellipsoids = fit->proxy.ellipsoids().size();
    result.approximation = judge.judge(shapes_of(fit->proxy));
  }
  return result;
}

/// Runs once: it takes a second, and noise is small beside that.
MethodResult measure_stand_in(const Subject& subject, const Judge& judge, int tries) {
  const CpuClock clock;
  const auto& skin = subject.mesh.positions;
  const double stature_m = geometry::bounding_box(skin).size().y();
  const std::int64_t begin_ns = clock.now_ns();
  const StandInFit fit = fit_stand_in({}, skin, static_cast<std::size_t>(subject.paper.ellipsoids), tries,
                                      kLeastRadius * stature_m);
  MethodResult result{.fit_ms = clock.ms_since(begin_ns)};
  result.ellipsoids = fit.ellipsoids.size();
  result.backtracks = fit.backtracks;
  result.approximation = judge.judge(fit.ellipsoids);
  return result;
}

}  // namespace

engine::Result<Table2Row> measure_table2(const Subject& subject, const Effort& effort) {
  const Judge judge({}, subject.mesh, effort.samples);
  Table2Row row{subject.paper, subject.source, subject.mesh.positions.size(), {}};
  auto ours = measure_ours(subject, judge, effort.repeats);
  if (!ours) return ours.error();
  row.methods.push_back(std::move(*ours));
  row.methods.push_back(measure_stand_in(subject, judge, kMostTries));
  row.methods.back().method = "stand-in for [19]";
  row.methods.push_back(measure_stand_in(subject, judge, 1));
  row.methods.back().method = "stand-in, never going back";
  return row;
}

std::vector<bench::Table> table2(std::span<const Table2Row> rows) {
  bench::Table times("table2_times",
                     "Table 2, times. Here: processor time of one thread, segmentation and fitting. "
                     "Paper: the same on its machine, for its method and for [19].",
                     {"body", "source", "vertices", "paper's vertices", "ellipsoids", "paper's ellipsoids",
                      "method", "segment_ms", "fit_ms", "times_ours_timed", "splits taken back",
                      "paper: segment + fit (s)", "paper: total to its own (times)"});
  bench::Table quality(
      "table2_approximation",
      "Table 2, approximation, for which the paper gives no numbers. E is its measure, the mean radial "
      "distance between an ellipsoid and its vertices, each vertex counted for the ellipsoid nearest "
      "along the ray. The rest is judged by the exact signed distance to the skin: gap, from the "
      "union's surface to the skin; held, inside some ellipsoid.",
      {"body", "method", "ellipsoids", "E mean mm", "E worst mm", "gap mean mm", "gap 95 % mm",
       "interior held %", "not held of what is over 10 mm deep %", "skin outside %", "skin outside by mm"});
  for (const Table2Row& row : rows) {
    const PaperRow& p = row.paper;
    const double own_ms = row.methods[0].segment_ms + row.methods[0].fit_ms;
    for (const MethodResult& m : row.methods) {
      const bool ours = &m == &row.methods[0], theirs = &m == &row.methods[1];
      const double segment_s = ours ? p.ours_segment_s : p.theirs_segment_s;
      const double fit_s = ours ? p.ours_fit_s : p.theirs_fit_s;
      std::vector<bench::Cell> cells = {
          p.body,       row.source, row.vertices, p.vertices, m.ellipsoids,
          p.ellipsoids, m.method,   m.segment_ms, m.fit_ms,   (m.segment_ms + m.fit_ms) / own_ms,
          m.backtracks};
      if (ours || theirs) {
        char seconds[32];
        std::snprintf(seconds, sizeof seconds, "%.1f + %.1f", segment_s, fit_s);
        cells.emplace_back(seconds);
        cells.emplace_back((segment_s + fit_s) / (p.ours_segment_s + p.ours_fit_s));
      }
      times.add(std::move(cells));
      const Approximation& a = m.approximation;
      quality.add({p.body, m.method, m.ellipsoids, a.radial_mean_mm, a.radial_worst_mm, a.gap_mean_mm,
                   a.gap_p95_mm, a.interior_percent, a.leak_percent, a.outside_percent, a.outside_mm});
    }
  }
  return {times, quality};
}

}  // namespace paper_bench
