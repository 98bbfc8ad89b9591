#include "table2.hpp"

#include <algorithm>

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/fitting/fit.hpp>

#include "cpu_clock.hpp"
#include "rival.hpp"

namespace paper_bench {
namespace {

using namespace bodice;

constexpr double kLeastRadius = 3e-4;  // of stature, as in our own fits

std::vector<geometry::Ellipsoid> shapes_of(const proxy::BodyProxy& proxy) {
  std::vector<geometry::Ellipsoid> shapes;
  for (const auto& e : proxy.ellipsoids()) shapes.push_back(e.shape);
  return shapes;
}

void set_radial(const fitting::FitResult& fit, Approximation& a) {
  double sum = 0.0, count = 0.0;
  for (const auto& part : fit.parts) {
    sum += part.radial_error_mean_m * static_cast<double>(part.ellipsoids);
    count += static_cast<double>(part.ellipsoids);
    a.radial_worst_mm = std::max(a.radial_worst_mm, 1e3 * part.radial_error_max_m);
  }
  a.radial_mean_mm = count > 0.0 ? 1e3 * sum / count : 0.0;
}

void set_radial(const RivalFit& fit, Approximation& a) {
  double sum = 0.0;
  for (const double e : fit.error_m) {
    sum += 1e3 * e;
    a.radial_worst_mm = std::max(a.radial_worst_mm, 1e3 * e);
  }
  a.radial_mean_mm = fit.error_m.empty() ? 0.0 : sum / static_cast<double>(fit.error_m.size());
}

double fit_stage_ms(const fitting::FitResult& fit) {
  double ms = 0.0;
  for (const auto& stage : fit.stages)
    if (stage.name == "fit") ms += stage.ms;
  return ms;
}

engine::Result<void> measure_ours(const Subject& subject, const Judge& judge, int repeats, Table2Row& row) {
  const CpuClock clock;
  engine::Context context;
  context.clock = &clock;
  row.ours.segment_ms = row.ours.fit_ms = 1e30;
  const auto profile = body::find_profile("gb10000-88");
  if (!profile) return profile.error();
  for (int r = 0; r < repeats; ++r) {
    const std::int64_t begin_ns = clock.now_ns();
    const auto anatomy = anatomy::analyse(context, subject.mesh, {.profile = *profile});
    if (!anatomy) return anatomy.error();
    row.ours.segment_ms = std::min(row.ours.segment_ms, clock.ms_since(begin_ns));
    const auto fit =
        fitting::fit(context, {subject.mesh, anatomy->part, anatomy->stature_m, {}, &judge.distance()},
                     {.tier = proxy::Tier::kPaper, .max_ellipsoids = subject.paper.ellipsoids});
    if (!fit) return fit.error();
    row.ours.fit_ms = std::min(row.ours.fit_ms, fit_stage_ms(*fit));
    if (r > 0) continue;
    row.ours.ellipsoids = fit->proxy.ellipsoids().size();
    row.ours.approximation = judge.judge(shapes_of(fit->proxy));
    set_radial(*fit, row.ours.approximation);
    row.mu_torso_mm = 1e3 * fit->mu_torso_m;
    row.mu_limbs_mm = 1e3 * fit->mu_limbs_m;
  }
  return {};
}

void measure_rival(const Subject& subject, const Judge& judge, int repeats, Table2Row& row) {
  const CpuClock clock;
  const auto& skin = subject.mesh.positions;
  const double stature_m = geometry::bounding_box(skin).size().y();
  row.rival.fit_ms = 1e30;
  for (int r = 0; r < repeats; ++r) {
    const std::int64_t begin_ns = clock.now_ns();
    const RivalFit fit =
        fit_rival({}, skin, static_cast<std::size_t>(subject.paper.ellipsoids), kLeastRadius * stature_m);
    row.rival.fit_ms = std::min(row.rival.fit_ms, clock.ms_since(begin_ns));
    if (r > 0) continue;
    row.rival.ellipsoids = fit.ellipsoids.size();
    row.rival.approximation = judge.judge(fit.ellipsoids);
    set_radial(fit, row.rival.approximation);
    row.rival_backtracks = fit.backtracks;
    row.rival_iterations = fit.kmeans_iterations;
  }
}

}  // namespace

engine::Result<Table2Row> measure_table2(const Subject& subject, const Effort& effort) {
  const Judge judge({}, subject.mesh, effort.samples);
  Table2Row row{.paper = subject.paper, .source = subject.source};
  row.vertices = subject.mesh.positions.size();
  if (auto ok = measure_ours(subject, judge, effort.repeats, row); !ok) return ok.error();
  measure_rival(subject, judge, effort.repeats, row);
  return row;
}

}  // namespace paper_bench
