#include "laws.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace fit_bench {
namespace {

struct Line {
  double at_zero = 0.0, slope = 0.0, worst = 0.0;
};

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

}  // namespace

void print_laws(const std::vector<LawPoint>& points) {
  constexpr double kLeastCount = 16.0;
  struct Columns {
    std::vector<double> log_ratio, log_gap;
  };
  std::map<std::string, Columns> tiers;
  for (const LawPoint& p : points) {
    if (p.ellipsoids < kLeastCount || !(p.gap_of_stature > 0.0)) continue;
    Columns& c = tiers[p.tier];
    c.log_ratio.push_back(std::log(89.0 / p.ellipsoids));
    c.log_gap.push_back(std::log(p.gap_of_stature));
  }
  std::printf("tier,fits,at_89_of_stature,power,worst_factor\n");
  for (const auto& [tier, c] : tiers) {
    const Line gap = line_through(c.log_ratio, c.log_gap);
    std::printf("%s,%zu,%.6f,%.2f,%.2f\n", tier.c_str(), c.log_gap.size(), std::exp(gap.at_zero), gap.slope,
                std::exp(gap.worst));
  }
}

}  // namespace fit_bench
