// Float or double: the vector kernels of the frame path against the reference in double.
#include <algorithm>
#include <cmath>

#include <bodice/collision/collider.hpp>
#include <bodice/proxy/proxy_distance.hpp>

#include "contender.hpp"
#include "judge.hpp"
#include "must.hpp"
#include "sweep.hpp"

namespace tradeoff {
namespace {

using namespace bodice;

std::vector<float> in_double(const proxy::BodyProxy& proxy, const bench::Cloud& particles) {
  std::vector<float> found;
  for (std::size_t i = 0; i < particles.size(); ++i)
    found.push_back(static_cast<float>(proxy::proxy_distance(proxy, particles.at(i)).distance));
  return found;
}

void add_tier(const Setting& setting, const Subject& subject, proxy::Tier tier, bench::Table& table) {
  progress("precision", std::string(proxy::name(tier)));
  const auto fit = must(fitting::fit(setting.context, tryon::labeled(subject.skin),
                                     {.tier = tier, .max_ellipsoids = setting.by_effort(15, 30, 89)}));
  std::vector<Contender> one{of_proxy(subject, fit, "")};
  const double float_ns = time_all(one, 5)[0].query_ns;
  const std::vector<float> narrow = one[0].distances_m(), wide = in_double(fit.proxy, subject.particles);
  const double double_ns = 1e3 * least_us([&] { in_double(fit.proxy, subject.particles); }, 1) /
                           static_cast<double>(subject.particles.size());
  double sum = 0.0, most = 0.0;
  for (std::size_t i = 0; i < wide.size(); ++i) {
    const double um = 1e6 * std::abs(static_cast<double>(narrow[i]) - static_cast<double>(wide[i]));
    sum += um, most = std::max(most, um);
  }
  table.add({proxy::name(tier), fit.proxy.ellipsoids().size(), sum / static_cast<double>(wide.size()), most,
             judge(narrow, subject.truth_m, true).mean_mm, judge(wide, subject.truth_m, true).mean_mm,
             float_ns, double_ns, double_ns / float_ns});
}

}  // namespace

Findings sweep_precision(const Setting& setting) {
  const Subject subject = made_bodies(0, 1, setting.vertices())[0].make(setting.context);
  bench::Table table("precision", "The same proxy, answered in float and in double, one thread.",
                     {"tier", "ellipsoids", "difference_mean_um", "difference_max_um", "float_error_mm",
                      "double_error_mm", "float_ns", "double_ns", "double_over_float_timed"});
  for (const proxy::Tier tier : {proxy::Tier::kSolid, proxy::Tier::kTight, proxy::Tier::kRelief})
    if (setting.effort != Effort::kSmallest || tier == proxy::Tier::kSolid)
      add_tier(setting, subject, tier, table);
  Findings found;
  found.text = "The error of floats is far below that of the fit.\n";
  found.shown.push_back(std::move(table));
  return found;
}

}  // namespace tradeoff
