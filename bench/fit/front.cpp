#include <cstdio>

#include "front_svg.hpp"
#include "query_cost.hpp"
#include "questions.hpp"

namespace fit_bench {
namespace {

using namespace bodice;

void print_line(const std::string& name, const fitting::FitResult& r, const bench::NearSkin& near,
                double ns) {
  const auto& a = r.accuracy;
  std::printf("%s,%s,%zu,%zu,", name.c_str(), std::string(proxy::name(r.proxy.tier())).c_str(),
              r.proxy.ellipsoids().size(), r.proxy.bytes());
  std::printf("%.1f,%.1f,%.1f,%.1f,", stage_ms(r, "fit"), stage_ms(r, "tight"), stage_ms(r, "relief"),
              stage_ms(r, "measure"));
  std::printf("%.3f,%.3f,%.2f,%.3f,%.3f,%.2f,", 1e3 * a.gap_m.mean, 1e3 * a.gap_m.p95, 1e3 * a.gap_m.max,
              a.interior_covered_percent, a.skin_outside_percent, 1e3 * a.skin_outside_depth_m);
  std::printf("%.3f,%.3f,%.3f,%.3f,%.2f,%d,", near.mean_mm, near.p95_mm, near.missed_percent,
              near.false_percent, near.max_mm, near.deep_leaks);
  std::printf("%.2f,%.2f,%.1f\n", 1e3 * r.mu_torso_m, 1e3 * r.mu_limbs_m, ns);
  std::fflush(stdout);
}

}  // namespace

bool print_front(const engine::Context& context, const Arguments& arguments) {
  std::printf(
      "body,tier,ellipsoids,bytes,fit_ms,tight_ms,relief_ms,measure_ms,gap_mean_mm,gap_p95_mm,gap_max_mm,"
      "interior_percent,uncovered_percent,uncovered_mm,near_mean_mm,near_p95_mm,missed_percent,false_percent,"
      "near_max_mm,deep_leaks,mu_torso_mm,mu_limbs_mm,query_ns\n");
  std::vector<FrontPoint> points;
  const auto judge = [&](const Subject& subject, int count, const fitting::FitResult& result) {
    const auto near = bench::judge(context, result.proxy, subject.probes);
    print_line(subject.name, result, near, query_ns(result.proxy, subject.body.mesh));
    points.push_back(
        {std::string(proxy::name(result.proxy.tier())), static_cast<double>(count), near.mean_mm});
  };
  const bool all = for_each_fit(context, arguments, judge);
  return all && (arguments.svg.empty() || write_front_svg(arguments.svg, points));
}

}  // namespace fit_bench
