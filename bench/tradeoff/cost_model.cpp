// The cost model that turns a time budget into a number of ellipsoids, against measured times: how well it
// holds from body to body, and how much slower this machine is than the one that it was made on.
#include <algorithm>
#include <vector>

#include <bodice/fitting/cost_model.hpp>

#include "contender.hpp"
#include "must.hpp"
#include "sweep.hpp"

namespace tradeoff {
namespace {

using namespace bodice;
using proxy::Tier;

/// A proxy and the time of a query.
struct Point {
  std::string body;
  Tier tier = Tier::kTight;
  int ellipsoids = 0;
  double frame_us = 0.0;

  double over_model() const { return frame_us / fitting::predicted_frame_us(tier, ellipsoids); }
};

/// The least-squares line through the points of a tier, nanoseconds a particle.
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
  constexpr std::uint64_t kFirstSeed = 2000;  // the sweep of targets uses other seeds
  const auto counts = setting.by_effort<std::vector<int>>({16, 24}, {16, 45, 89}, {16, 24, 32, 45, 60, 89});
  std::vector<Point> points;
  std::vector<Contender> contenders;
  for (const SubjectSource& source :
       made_bodies(kFirstSeed, setting.bodies(1, 1, 4), setting.by_effort(1500, 3000, 4500))) {
    const Subject subject = source.make(setting.context);
    for (const Tier tier : {Tier::kTight, Tier::kRelief})
      for (const int count : counts) {
        progress("cost-model",
                 subject.name + ", " + std::string(proxy::name(tier)) + " " + std::to_string(count));
        const auto fit =
            must(fitting::fit(setting.context, tryon::labeled(subject.skin),
                              {.tier = tier, .max_ellipsoids = count, .measure_accuracy = false}));
        points.push_back({subject.name, tier, static_cast<int>(fit.proxy.ellipsoids().size())});
        contenders.push_back(of_proxy(subject, fit, ""));
      }
  }
  progress("cost-model", "timing");
  const std::vector<Cost> costs = time_all(contenders, setting.by_effort(3, 30, 60));
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i].frame_us = 1e-3 * kFrameParticles * costs[i].query_ns;
  return points;
}

void add_tier(const std::vector<Point>& points, Tier tier, bench::Table& table) {
  const Line line = line_through(points, tier);
  std::vector<double> ratios;
  for (const Point& p : points)
    if (p.tier == tier) ratios.push_back(p.over_model());
  std::ranges::sort(ratios);
  const double model_fixed_ns = 0.1 * fitting::predicted_frame_us(tier, 0);
  const double model_each_ns = 0.001 * (fitting::predicted_frame_us(tier, 100) - 10.0 * model_fixed_ns);
  table.add({proxy::name(tier), ratios.size(), line.fixed_ns, line.each_ns, model_fixed_ns, model_each_ns,
             ratios.front(), ratios[ratios.size() / 2], ratios.back()});
}

}  // namespace

Findings sweep_cost_model(const Setting& setting) {
  const std::vector<Point> points = measure(setting);
  bench::Table model(
      "cost_model",
      "Nanoseconds a particle, fixed and for each ellipsoid, and measured times over the model's.",
      {"tier", "proxies", "fixed_ns", "each_ns", "model_fixed_ns", "model_each_ns", "least_ratio_timed",
       "median_ratio_timed", "largest_ratio_timed"});
  for (const Tier tier : {Tier::kTight, Tier::kRelief}) add_tier(points, tier, model);
  bench::Table by_body("cost_model_by_body", "Time of 10,000 particles beside the model's.",
                       {"body", "tier", "ellipsoids", "query_us", "ratio_timed"});
  for (const Point& p : points)
    by_body.add({p.body, proxy::name(p.tier), p.ellipsoids, p.frame_us, p.over_model()});
  Findings found;
  found.text =
      "`--budget-us` uses a cost model in place of a measurement, so that the same command gives the same "
      "proxy "
      "everywhere. It is time on the machine of the model: one thread of a 2.5 GHz server with AVX-512. On "
      "this "
      "machine a query takes the median ratio times as long; where that is 2, give half of what you want.\n";
  found.shown.push_back(std::move(model));
  found.details.push_back(std::move(by_body));
  return found;
}

}  // namespace tradeoff
