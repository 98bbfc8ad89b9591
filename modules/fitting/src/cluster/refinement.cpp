#include "cluster/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <bodice/engine/parallel.hpp>
#include <bodice/fitting/mvee.hpp>

#include "base/tolerant_argmax.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

/// A cluster with fewer items is not split: an ellipsoid needs four points to have a volume.
constexpr std::size_t kMinItemsToSplit = 8;
/// A cluster's error is rarely more than this factor above the error of its points to its earlier ellipsoid.
constexpr double kCautious = 1.35;
constexpr double kUnknown = std::numeric_limits<double>::infinity();  // error of a cluster never fitted

body::Part majority_part(const Items& items, std::span<const Index> members) {
  std::array<std::size_t, body::kAllPartCount> votes{};
  for (const Index i : members) ++votes[static_cast<int>(items.part[i])];
  return static_cast<body::Part>(std::max_element(votes.begin(), votes.end()) - votes.begin());
}

std::vector<Vec3> points_of(const Items& items, std::span<const Index> members) {
  std::vector<Vec3> points;
  for (const Index i : members) points.push_back(items.where[i]);
  return points;
}

/// At most 64 points of the items, enough for an estimate.
std::vector<Vec3> some_points(const Items& items, std::span<const Index> members) {
  constexpr std::size_t kMost = 64;
  const std::size_t stride = members.size() / kMost + 1;
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < members.size(); i += stride) points.push_back(items.where[members[i]]);
  return points;
}

std::vector<double> weights_of(const Items& items, std::span<const Index> members) {
  std::vector<double> weights;
  for (const Index i : members) weights.push_back(items.weight[i]);
  return weights;
}

}  // namespace

double radial_distance(const geometry::Ellipsoid& e, const Vec3& p) {
  const double level = geometry::level(e, p);
  return level > 0.0 ? (p - e.center).norm() * std::abs(1.0 - 1.0 / std::sqrt(level)) : e.radii.minCoeff();
}

double radial_error(const geometry::Ellipsoid& ellipsoid, std::span<const Vec3> points) {
  double sum = 0.0;
  for (const Vec3& p : points) sum += radial_distance(ellipsoid, p);
  return points.empty() ? 0.0 : sum / static_cast<double>(points.size());
}

std::vector<Vec3> enclosed_points(const Items& items, std::span<const Index> members) {
  std::vector<Vec3> points;
  if (items.encloses.empty()) {
    for (const Index i : members) points.push_back(items.where[i]);
    return points;
  }
  std::vector<Index> ids;
  for (const Index i : members) ids.insert(ids.end(), items.encloses[i].begin(), items.encloses[i].end());
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  for (const Index i : ids) points.push_back(items.points[i]);
  return points;
}

Refinement::Refinement(const engine::Context& context, const Items& items, const Region& region,
                       const RefineOptions& options)
    : context_(context),
      items_(items),
      region_(region),
      options_(options),
      where_(points_of(items, region_.items)),
      weight_(weights_of(items, region_.items)),
      lloyd_(fresh_lloyd()) {
  recluster(region_.seeds);
}

void Refinement::run(double mu_m, std::size_t most) {
  // A split that leaves a cluster empty adds none, so that the number of items bounds the splits.
  for (std::size_t step = 0; step < where_.size() && clusters_.size() < most; ++step) {
    std::size_t worst = find_worst();
    if (worst == clusters_.size()) break;
    if (!(clusters_[worst].error_m > mu_m)) {
      fit_rest();
      worst = find_worst();
      if (worst == clusters_.size() || !(clusters_[worst].error_m > mu_m)) break;
    }
    context_.checkpoint();
    split(worst);
  }
  fit_rest();
}

/// K-means without earlier state, with an origin near the region's points.
Lloyd Refinement::fresh_lloyd() const {
  return {where_, weight_, where_.empty() ? Vec3(Vec3::Zero()) : where_.front()};
}

/// The cluster with the largest error of those that can be split, fitted; #clusters if none can be split.
/// Clusters that only gained or lost points at their border are not fitted before they seem the worst.
std::size_t Refinement::find_worst() {
  while (true) {
    std::vector<double> error;
    std::vector<std::size_t> unknown;
    for (std::size_t k = 0; k < clusters_.size(); ++k) {
      const Cluster& c = clusters_[k];
      error.push_back(c.items.size() < kMinItemsToSplit ? 0.0 : c.error_m);
      if (std::isinf(error.back())) unknown.push_back(k);
    }
    const std::size_t worst = tolerant_argmax(error);
    if (worst == clusters_.size() || clusters_[worst].fitted) return worst;
    if (unknown.empty()) unknown.push_back(worst);
    fit(unknown);
  }
}

void Refinement::split(std::size_t worst) {
  int longest = 0;
  const geometry::Ellipsoid& e = clusters_[worst].ellipsoid;
  e.radii.maxCoeff(&longest);
  const Vec3 end = e.radii[longest] * e.axes.col(longest);
  std::vector<Vec3> centers = centers_;
  centers[worst] = e.center - end;
  centers.push_back(e.center + end);
  clusters_[worst].error_m = kUnknown;  // the error of the whole cluster is none of a half's
  clusters_[worst].fitted = false;
  recluster(std::move(centers));
}

void Refinement::recluster(std::vector<Vec3> centers) {
  lloyd_.run(context_, std::move(centers), {options_.sigma_m, 50});
  std::vector<std::vector<Index>> members(lloyd_.centers().size());
  const std::vector<Index> of_item = lloyd_.of_point();
  for (std::size_t i = 0; i < region_.items.size(); ++i) members[of_item[i]].push_back(region_.items[i]);
  centers_ = lloyd_.centers();
  set_members(std::move(members));
  if (centers_.size() != lloyd_.centers().size()) lloyd_ = fresh_lloyd();  // centers were renumbered
  if (!options_.reclassify) return;
  fit_rest();
  reclassify();
}

/// Drops the empty clusters. Clusters with other members than before are marked for fitting; until then their
/// error is estimated with their earlier ellipsoid.
void Refinement::set_members(std::vector<std::vector<Index>> members) {
  std::vector<Cluster> next;
  std::vector<Vec3> centers;
  std::vector<std::size_t> changed;
  for (std::size_t k = 0; k < members.size(); ++k) {
    if (members[k].empty()) continue;
    if (k < clusters_.size()) {
      next.push_back(std::move(clusters_[k]));
    } else {
      next.emplace_back().error_m = kUnknown;
    }
    if (next.back().items != members[k]) {
      next.back().items = std::move(members[k]);
      next.back().fitted = false;
      if (next.back().error_m < kUnknown) changed.push_back(next.size() - 1);
    }
    centers.push_back(centers_[k]);
  }
  clusters_ = std::move(next);
  centers_ = std::move(centers);
  engine::parallel_for(context_, changed.size(), 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Cluster& cluster = clusters_[changed[i]];
      cluster.error_m = kCautious * radial_error(cluster.ellipsoid, some_points(items_, cluster.items));
    }
  });
}

void Refinement::fit(std::span<const std::size_t> which) {
  engine::parallel_for(context_, which.size(), 1, [&](std::size_t i, std::size_t) {
    Cluster& cluster = clusters_[which[i]];
    const std::vector<Vec3> points = enclosed_points(items_, cluster.items);
    // A relative volume of 1e-4 moves a radius by a thirty-thousandth: far below every threshold mu.
    cluster.ellipsoid = mvee(points, {1e-4, options_.min_radius_m}).ellipsoid;
    cluster.error_m = radial_error(cluster.ellipsoid, points);
    cluster.part = majority_part(items_, cluster.items);
    cluster.fitted = true;
  });
}

void Refinement::fit_rest() {
  std::vector<std::size_t> rest;
  for (std::size_t k = 0; k < clusters_.size(); ++k)
    if (!clusters_[k].fitted) rest.push_back(k);
  fit(rest);
}

/// Eq. (8) as one simultaneous pass, so that no order matters: a point that lies in several ellipsoids goes
/// to the one with the nearest surface along the ray. The pass is undone unless the largest error falls.
void Refinement::reclassify() {
  const std::vector<Cluster> before = clusters_;
  const std::vector<Vec3> centers_before = centers_;
  std::vector<std::vector<Index>> members(clusters_.size());
  for (std::size_t k = 0; k < before.size(); ++k)
    for (const Index i : before[k].items) {
      std::size_t best = k;
      double least = radial_distance(before[k].ellipsoid, items_.where[i]);
      for (std::size_t j = 0; j < before.size(); ++j) {
        if (j == k || geometry::level(before[j].ellipsoid, items_.where[i]) > 1.0) continue;
        const double distance = radial_distance(before[j].ellipsoid, items_.where[i]);
        if (distance < least) least = distance, best = j;
      }
      members[best].push_back(i);
    }
  for (auto& list : members) std::sort(list.begin(), list.end());
  double worst_before = 0.0, worst_after = 0.0;
  for (const Cluster& c : before) worst_before = std::max(worst_before, c.error_m);
  set_members(std::move(members));
  fit_rest();
  for (const Cluster& c : clusters_) worst_after = std::max(worst_after, c.error_m);
  if (worst_after < worst_before) return;
  clusters_ = before;
  centers_ = centers_before;
}

}  // namespace bodice::fitting
