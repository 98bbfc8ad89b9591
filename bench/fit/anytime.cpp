#include "anytime.hpp"

#include <chrono>
#include <cstdio>
#include <utility>

namespace fit_bench {

bool print_anytime(const bodice::engine::Context& context, const std::string& name,
                   const bodice::fitting::LabeledSkin& skin, const std::vector<bench::Probe>& probes,
                   bodice::proxy::Tier tier) {
  using namespace bodice;
  using Clock = std::chrono::steady_clock;
  fitting::FitOptions options;
  options.tier = tier;
  options.max_ellipsoids = 89;
  options.measure_accuracy = false;
  options.time_budget_s = 0.0;
  const auto start = fitting::fit(context, skin, options);
  options.time_budget_s.reset();
  std::vector<std::pair<double, proxy::BodyProxy>> published;
  const auto began = Clock::now();
  const auto ms = [&] { return std::chrono::duration<double, std::milli>(Clock::now() - began).count(); };
  options.on_improved = [&](const proxy::BodyProxy& found) { published.emplace_back(ms(), found); };
  const auto end = fitting::fit(context, skin, options);
  if (!start || !end) return false;
  published.emplace_back(ms(), end->proxy);
  const double first = bench::judge(context, start->proxy, probes).mean_mm;
  const double last = bench::judge(context, end->proxy, probes).mean_mm;
  double half_ms = 0.0;
  std::printf("%s,0,%.3f\n", name.c_str(), first);
  for (const auto& [at_ms, found] : published) {
    const double mean_mm = bench::judge(context, found, probes).mean_mm;
    if (half_ms == 0.0 && first - mean_mm >= 0.5 * (first - last)) half_ms = at_ms;
    std::printf("%s,%.0f,%.3f\n", name.c_str(), at_ms, mean_mm);
  }
  std::printf("# %s: half of the gain after %.0f ms, all after %.0f ms\n", name.c_str(), half_ms,
              published.back().first);
  return true;
}

}  // namespace fit_bench
