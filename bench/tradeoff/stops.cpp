// Where inner iterations of fits stop: the gap of enclosing ellipsoids, and sigma of K-means.
#include <cmath>

#include <bodice/engine/random.hpp>
#include <bodice/fitting/kmeans.hpp>
#include <bodice/fitting/mvee.hpp>

#include "contender.hpp"
#include "sweep.hpp"

namespace tradeoff {
namespace {

using namespace bodice;
using geometry::Vec3;

using PointSets = std::vector<std::vector<Vec3>>;

PointSets points_by_part(const Subject& subject) {
  PointSets sets(body::kPartCount);
  const auto& part = subject.skin.anatomy.part;
  for (std::size_t v = 0; v < part.size(); ++v)
    sets[static_cast<std::size_t>(part[v])].push_back(subject.skin.input.skin.positions[v]);
  std::erase_if(sets, [](const auto& set) { return set.empty(); });
  return sets;
}

/// Points on a stretched sphere: the hard case, in which every point matters.
PointSets stretched_sphere(std::size_t count) {
  engine::Random random(9);
  PointSets sets(1);
  for (std::size_t i = 0; i < count; ++i) {
    const double a = random.normal(), b = random.normal(), c = random.normal();
    sets[0].push_back(Vec3(a, b, c).normalized().cwiseProduct(Vec3(0.2, 0.1, 0.08)));
  }
  return sets;
}

using Enclose = std::function<fitting::Mvee(std::span<const Vec3>)>;

double volume(const fitting::Mvee& found) {
  return found.ellipsoid.radii.prod();
}

void add_row(const char* points, const PointSets& sets, const char* method, double tolerance,
             const Enclose& enclose, bench::Table& table) {
  double excess = 0.0, gap = 0.0, violation = 0.0, rounds = 0.0, us = 0.0;
  const auto count = static_cast<double>(sets.size());
  for (const auto& set : sets) {
    const fitting::Mvee found = enclose(set);
    const double least = volume(fitting::mvee(set, {.volume_tolerance = 1e-10}));
    excess = std::max(excess, 100.0 * (volume(found) / least - 1.0));
    gap = std::max(gap, found.volume_gap);
    violation = std::max(violation, found.violation);
    rounds += found.rounds / count;
    us += least_us([&] { enclose(set); }, 3) / count;
  }
  table.add({points, sets.size(), method, tolerance, excess, gap, violation, rounds, us});
}

bench::Table enclosing(const Setting& setting, const Subject& subject) {
  bench::Table table("mvee",
                     "Enclosing ellipsoids: the stop, and for the worst set the volume above the least, the "
                     "certified gap and the farthest point outside.",
                     {"points", "sets", "method", "stop", "excess_volume_%", "certified_gap", "violation",
                      "rounds", "time_us"});
  const std::pair<const char*, PointSets> all[] = {
      {"parts of a body", points_by_part(subject)},
      {"stretched sphere", stretched_sphere(setting.by_effort<std::size_t>(200, 1000, 5000))}};
  for (const auto& [name, sets] : all) {
    progress("stops", std::string("enclosing ") + name);
    for (const double stop : {1e-1, 1e-2, 1e-4, 1e-7})
      add_row(
          name, sets, "active set", stop,
          [stop](auto set) { return fitting::mvee(set, {.volume_tolerance = stop}); }, table);
    for (const double stop : {1e-1, 1e-2, 1e-3})
      add_row(
          name, sets, "first order", stop, [stop](auto set) { return fitting::mvee_first_order(set, stop); },
          table);
  }
  return table;
}

double rms_mm(const std::vector<Vec3>& points, const fitting::Clusters& clusters) {
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    sum += (points[i] - clusters.centers[clusters.of_point[i]]).squaredNorm();
  return 1e3 * std::sqrt(sum / static_cast<double>(points.size()));
}

bench::Table clustering(const Setting& setting, const Subject& subject) {
  bench::Table table(
      "kmeans",
      "K-means over the skin's vertices. It stops when no center moves farther than sigma (the "
      "paper's eq. 7); the spread is the root mean square distance from the center.",
      {"centers", "sigma_mm", "iterations", "spread_mm", "above_converged_%", "time_us"});
  const std::vector<Vec3>& points = subject.skin.input.skin.positions;
  for (const std::size_t count : setting.by_effort<std::vector<std::size_t>>({15}, {15, 89}, {15, 89, 200})) {
    progress("stops", "K-means, " + std::to_string(count) + " centers");
    std::vector<Vec3> start;
    for (std::size_t i = 0; i < count; ++i) start.push_back(points[i * points.size() / count]);
    const auto solve = [&](double sigma_m) {
      return fitting::kmeans({}, points, {}, start, {.sigma_m = sigma_m, .max_iterations = 1000});
    };
    const double converged = rms_mm(points, solve(0.0));
    for (const double sigma_mm : {0.0, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0}) {
      const fitting::Clusters found = solve(1e-3 * sigma_mm);
      const double spread = rms_mm(points, found);
      table.add({count, sigma_mm, found.iterations, spread, 100.0 * (spread / converged - 1.0),
                 least_us([&] { solve(1e-3 * sigma_mm); }, 1)});
    }
  }
  return table;
}

}  // namespace

Findings sweep_stops(const Setting& setting) {
  const Subject subject = made_bodies(0, 1, setting.vertices())[0].make(setting.context);
  Findings found;
  found.text = "One thread, processor time, the least of five.\n";
  found.shown.push_back(enclosing(setting, subject));
  found.shown.push_back(clustering(setting, subject));
  return found;
}

}  // namespace tradeoff
