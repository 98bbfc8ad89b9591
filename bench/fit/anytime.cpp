#include <chrono>
#include <cstdio>
#include <utility>

#include "questions.hpp"

namespace fit_bench {
namespace {

using namespace bodice;
using Clock = std::chrono::steady_clock;
using Published = std::vector<std::pair<double, proxy::BodyProxy>>;  // milliseconds since the fit began

/// Prints the errors of the published proxies; `first` is the proxy of a fit without time.
void print_course(const engine::Context& context, const Subject& subject, const proxy::BodyProxy& first,
                  const Published& published) {
  const char* const name = subject.name.c_str();
  const double first_mm = bench::judge(context, first, subject.probes).mean_mm;
  const double last_mm = bench::judge(context, published.back().second, subject.probes).mean_mm;
  double half_ms = 0.0;
  std::printf("%s,0,%.3f\n", name, first_mm);
  for (const auto& [at_ms, found] : published) {
    const double mean_mm = bench::judge(context, found, subject.probes).mean_mm;
    if (half_ms == 0.0 && first_mm - mean_mm >= 0.5 * (first_mm - last_mm)) half_ms = at_ms;
    std::printf("%s,%.0f,%.3f\n", name, at_ms, mean_mm);
  }
  std::printf("# %s: half of the gain after %.0f ms, all after %.0f ms\n", name, half_ms,
              published.back().first);
}

bool print_tier(const engine::Context& context, const Subject& subject, proxy::Tier tier) {
  fitting::FitOptions options;
  options.tier = tier;
  options.max_ellipsoids = 89;
  options.measure_accuracy = false;
  options.time_budget_s = 0.0;
  const auto first = fitted(context, subject, options);
  options.time_budget_s.reset();
  Published published;
  const auto began = Clock::now();
  const auto ms = [&] { return std::chrono::duration<double, std::milli>(Clock::now() - began).count(); };
  options.on_improved = [&](const proxy::BodyProxy& found) { published.emplace_back(ms(), found); };
  const auto last = fitted(context, subject, options);
  if (!first || !last) return false;
  published.emplace_back(ms(), last->proxy);
  print_course(context, subject, first->proxy, published);
  return true;
}

}  // namespace

bool print_anytime(const engine::Context& context, const Arguments& arguments) {
  std::printf("body,ms,near_mean_mm\n");
  return for_each_subject(context, arguments, [&](const Subject& subject) {
    for (const proxy::Tier tier : arguments.tiers)
      if (!print_tier(context, subject, tier)) return false;
    return true;
  });
}

}  // namespace fit_bench
