#include "refine.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>
#include <bodice/fitting/mvee.hpp>

#include "first_largest.hpp"

namespace bodice::fitting {
namespace {

/// Fewer items than this are not split: an ellipsoid needs four points to have a volume.
constexpr std::size_t kMinItemsToSplit = 8;

body::Part majority_part(const Items& items, std::span<const Index> members) {
  std::array<std::size_t, body::kPartCount> votes{};
  for (const Index i : members) ++votes[static_cast<int>(items.part[i])];
  return static_cast<body::Part>(std::max_element(votes.begin(), votes.end()) - votes.begin());
}

std::vector<Vec3> points_of(const Items& items, std::span<const Index> members) {
  std::vector<Vec3> points;
  for (const Index i : members) points.push_back(items.where[i]);
  return points;
}

std::vector<double> weights_of(const Items& items, std::span<const Index> members) {
  std::vector<double> weights;
  for (const Index i : members) weights.push_back(items.weight[i]);
  return weights;
}

double radial_distance(const geometry::Ellipsoid& e, const Vec3& p) {
  const double level = geometry::level(e, p);
  return level > 0.0 ? (p - e.center).norm() * std::abs(1.0 - 1.0 / std::sqrt(level)) : e.radii.minCoeff();
}

}  // namespace

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
  // A split that empties a cluster adds none: bounded by the items all the same.
  for (std::size_t step = 0; step < where_.size() && clusters_.size() < most; ++step) {
    if (!(worst_error() > mu_m)) break;
    context_.checkpoint();
    split_worst();
  }
}

/// K-means without a past, measuring from near the region's points.
Lloyd Refinement::fresh_lloyd() const {
  return {where_, weight_, where_.empty() ? Vec3(Vec3::Zero()) : where_.front()};
}

double Refinement::worst_error() const {
  double worst = 0.0;
  for (const Cluster& c : clusters_)
    if (c.items.size() >= kMinItemsToSplit) worst = std::max(worst, c.error_m);
  return worst;
}

void Refinement::split_worst() {
  std::vector<double> error;
  for (const Cluster& c : clusters_) error.push_back(c.items.size() < kMinItemsToSplit ? 0.0 : c.error_m);
  const std::size_t worst = first_largest(error);
  if (worst == clusters_.size()) return;
  int longest = 0;
  const geometry::Ellipsoid& e = clusters_[worst].ellipsoid;
  e.radii.maxCoeff(&longest);
  const Vec3 end = e.radii[longest] * e.axes.col(longest);
  std::vector<Vec3> centers = centers_;
  centers[worst] = e.center - end;
  centers.push_back(e.center + end);
  recluster(std::move(centers));
}

void Refinement::recluster(std::vector<Vec3> centers) {
  lloyd_.run(context_, std::move(centers), {options_.sigma_m, 50});
  std::vector<std::vector<Index>> members(lloyd_.centers().size());
  for (std::size_t i = 0; i < region_.items.size(); ++i)
    members[lloyd_.of_point()[i]].push_back(region_.items[i]);
  centers_ = lloyd_.centers();
  set_members(std::move(members));
  if (centers_.size() != lloyd_.centers().size()) lloyd_ = fresh_lloyd();  // centres were renumbered
  if (options_.reclassify) reclassify();
}

/// Fits the clusters whose members changed and drops the empty ones.
void Refinement::set_members(std::vector<std::vector<Index>> members) {
  std::vector<Cluster> next;
  std::vector<Vec3> centers;
  std::vector<std::size_t> changed;
  for (std::size_t k = 0; k < members.size(); ++k) {
    if (members[k].empty()) continue;
    if (k < clusters_.size() && clusters_[k].items == members[k]) {
      next.push_back(std::move(clusters_[k]));
    } else {
      changed.push_back(next.size());
      next.emplace_back().items = std::move(members[k]);
    }
    centers.push_back(centers_[k]);
  }
  clusters_ = std::move(next);
  centers_ = std::move(centers);
  engine::parallel_for(context_, changed.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) fit(clusters_[changed[i]]);
  });
}

void Refinement::fit(Cluster& cluster) const {
  const std::vector<Vec3> points = enclosed_points(items_, cluster.items);
  // A relative volume of 1e-4 moves a radius by a thirty-thousandth: far below every threshold mu.
  cluster.ellipsoid = mvee(points, {1e-4, options_.min_radius_m}).ellipsoid;
  cluster.error_m = radial_error(cluster.ellipsoid, points);
  cluster.part = majority_part(items_, cluster.items);
}

/// Eq. (8) as one simultaneous pass, so that no order matters: a skin point that lies in several ellipsoids
/// goes to the one whose surface is nearest along the ray; the pass is undone if the worst error rises.
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
  for (const Cluster& c : clusters_) worst_after = std::max(worst_after, c.error_m);
  if (worst_after < worst_before) return;
  clusters_ = before;
  centers_ = centers_before;
}

}  // namespace bodice::fitting
