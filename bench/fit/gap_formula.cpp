#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "questions.hpp"

namespace fit_bench {
namespace {

using namespace bodice;

constexpr double kLeastCount = 16.0;  // the formula holds from this count up

struct Line {
  double at_zero = 0.0, slope = 0.0, worst = 0.0;
};

/// The least-squares line, with its largest residual.
Line line_through(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) sx += x[i], sy += y[i], sxx += x[i] * x[i], sxy += x[i] * y[i];
  Line line;
  line.slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  line.at_zero = (sy - line.slope * sx) / n;
  for (std::size_t i = 0; i < x.size(); ++i)
    line.worst = std::max(line.worst, std::abs(y[i] - line.at_zero - line.slope * x[i]));
  return line;
}

/// The fits of one tier.
struct Columns {
  std::vector<double> log_ratio;  ///< log(89 / count)
  std::vector<double> log_gap;    ///< log(gap / stature)
};

}  // namespace

bool print_gap_formula(const engine::Context& context, const Arguments& arguments) {
  std::map<std::string, Columns> tiers;
  const bool all =
      for_each_fit(context, arguments, [&](const Subject& subject, int, const fitting::FitResult& result) {
        const auto count = static_cast<double>(result.proxy.ellipsoids().size());
        const double gap = result.accuracy.gap_m.mean / subject.body.stature_m;
        if (count < kLeastCount || !(gap > 0.0)) return;
        Columns& c = tiers[std::string(proxy::name(result.proxy.tier()))];
        c.log_ratio.push_back(std::log(89.0 / count));
        c.log_gap.push_back(std::log(gap));
      });
  std::printf("tier,fits,at_89_of_stature,power,worst_factor\n");
  for (const auto& [tier, c] : tiers) {
    const Line gap = line_through(c.log_ratio, c.log_gap);
    std::printf("%s,%zu,%.6f,%.2f,%.2f\n", tier.c_str(), c.log_gap.size(), std::exp(gap.at_zero), gap.slope,
                std::exp(gap.worst));
  }
  return all;
}

}  // namespace fit_bench
