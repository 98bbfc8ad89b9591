// The law by which a budget of time becomes a count of ellipsoids, measured: how well it holds from body to
// body, and this machine's factor over the one that it was measured on.
#include <algorithm>
#include <vector>

#include <bodice/fitting/budget.hpp>

#include "contender.hpp"
#include "must.hpp"
#include "sweep.hpp"

namespace tradeoff {
namespace {

using namespace bodice;
using proxy::Tier;

constexpr double kFrameParticles = 1e4;

struct Point {
  std::string body;
  Tier tier = Tier::kTight;
  int ellipsoids = 0;
  double frame_us = 0.0;

  double over_law() const { return frame_us / fitting::predicted_frame_us(tier, ellipsoids); }
};

/// Least squares over the points of a tier, nanoseconds a particle.
struct Line {
  double fixed_ns = 0.0, each_ns = 0.0;
};

Line line_through(const std::vector<Point>& points, Tier tier) {
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (const Point& p : points) {
    if (p.tier != tier) continue;
    const double x = p.ellipsoids, y = 1e3 * p.frame_us / kFrameParticles;
    n += 1.0, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double each = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  return {(sy - each * sx) / n, each};
}

std::vector<Point> measure(const Setting& setting) {
  constexpr std::uint64_t kFirstSeed = 2000;  // none of those that the sweep of the dials judges the law by
  const auto counts = setting.by_effort<std::vector<int>>({16, 24}, {16, 45, 89}, {16, 24, 32, 45, 60, 89});
  std::vector<Point> points;
  std::vector<Contender> contenders;
  for (const SubjectSource& source :
       made_bodies(kFirstSeed, setting.bodies(1, 1, 4), setting.by_effort(1500, 3000, 4500))) {
    const Subject subject = source.make(setting.context);
    for (const Tier tier : {Tier::kTight, Tier::kRelief})
      for (const int count : counts) {
        progress("laws", subject.name + ", " + std::string(proxy::name(tier)) + " " + std::to_string(count));
        const auto fit =
            must(fitting::fit(setting.context, tryon::labeled(subject.skin),
                              {.tier = tier, .max_ellipsoids = count, .measure_accuracy = false}));
        points.push_back({subject.name, tier, static_cast<int>(fit.proxy.ellipsoids().size())});
        contenders.push_back(of_proxy(subject, fit, ""));
      }
  }
  progress("laws", "timing");
  const std::vector<Cost> costs = time_all(contenders, setting.by_effort(3, 30, 60));
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i].frame_us = 1e-3 * kFrameParticles * costs[i].query_ns;
  return points;
}

void add_law(const std::vector<Point>& points, Tier tier, bench::Table& table) {
  const Line line = line_through(points, tier);
  std::vector<double> ratios;
  for (const Point& p : points)
    if (p.tier == tier) ratios.push_back(p.over_law());
  std::ranges::sort(ratios);
  const double law_fixed_ns = 0.1 * fitting::predicted_frame_us(tier, 0);
  const double law_each_ns = 0.001 * (fitting::predicted_frame_us(tier, 100) - 10.0 * law_fixed_ns);
  table.add({proxy::name(tier), ratios.size(), line.fixed_ns, line.each_ns, law_fixed_ns, law_each_ns,
             ratios.front(), ratios[ratios.size() / 2], ratios.back()});
}

}  // namespace

Findings sweep_laws(const Setting& setting) {
  const std::vector<Point> points = measure(setting);
  bench::Table law("law",
                   "Nanoseconds a particle, fixed and for each ellipsoid, and times measured over the law's.",
                   {"tier", "proxies", "fixed_ns", "each_ns", "law_fixed_ns", "law_each_ns",
                    "least_ratio_timed", "median_ratio_timed", "largest_ratio_timed"});
  for (const Tier tier : {Tier::kTight, Tier::kRelief}) add_law(points, tier, law);
  bench::Table by_body("law_by_body", "Time of 10,000 particles beside the law's.",
                       {"body", "tier", "ellipsoids", "query_us", "ratio_timed"});
  for (const Point& p : points)
    by_body.add({p.body, proxy::name(p.tier), p.ellipsoids, p.frame_us, p.over_law()});
  Findings found;
  found.text =
      "`--budget-us` goes by a law and no clock, so that the same command gives the same proxy everywhere: "
      "it means time on the machine of the law, one thread of a 2.5 GHz server with AVX-512. On this machine "
      "a proxy takes the median ratio times as long: where that is 2, ask for half.\n";
  found.shown.push_back(std::move(law));
  found.details.push_back(std::move(by_body));
  return found;
}

}  // namespace tradeoff
