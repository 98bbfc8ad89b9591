#include <cstdio>

#include "query_cost.hpp"
#include "questions.hpp"

namespace fit_bench {
namespace {

using namespace bodice;

constexpr double kWithin = 1.2;  // a target is met within this factor

/// Counts requests and those met.
struct Count {
  int requested = 0, met = 0;
};

bool print_fit(const engine::Context& context, const Subject& subject, std::optional<double> target_mm,
               std::optional<double> budget_us, Count& count) {
  fitting::FitOptions options;
  if (target_mm) options.target_error_m = 1e-3 * *target_mm;
  options.budget_us = budget_us;
  const auto r = fitted(context, subject, options);
  if (!r) return false;
  const double achieved = 1e3 * r->accuracy.gap_m.mean;
  const double us = 10.0 * query_ns(r->proxy, subject.body.mesh);
  const double ratio = target_mm ? achieved / *target_mm : us / budget_us.value_or(us);
  ++count.requested;
  count.met += ratio <= kWithin && (!target_mm || ratio >= 1.0 / kWithin);
  std::printf("%s,%.3g,%.3f,%.3f,%.4g,%.1f,%s,%zu,%zu,%.0f\n", subject.name.c_str(), target_mm.value_or(0.0),
              achieved, ratio, budget_us.value_or(0.0), us, std::string(proxy::name(r->proxy.tier())).c_str(),
              r->proxy.ellipsoids().size(), r->proxy.bytes(), total_ms(*r));
  std::fflush(stdout);
  return true;
}

}  // namespace

bool print_targets(const engine::Context& context, const Arguments& arguments) {
  std::printf("body,target_mm,achieved_mm,ratio,budget_us,measured_us,tier,ellipsoids,bytes,total_ms\n");
  Count count;
  const bool all = for_each_subject(context, arguments, [&](const Subject& subject) {
    for (const double mm : arguments.targets_mm)
      if (!print_fit(context, subject, mm, std::nullopt, count)) return false;
    for (const double us : arguments.budgets_us)
      if (!print_fit(context, subject, std::nullopt, us, count)) return false;
    return true;
  });
  std::printf("# met %d of %d (bar: all, within a fifth)\n", count.met, count.requested);
  return all;
}

}  // namespace fit_bench
