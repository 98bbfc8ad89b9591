#include "refine.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>
#include <bodice/fitting/kmeans.hpp>
#include <bodice/fitting/mvee.hpp>

namespace bodice::fitting {
namespace {

/// Fewer items than this are not split: an ellipsoid needs four points to have a volume.
constexpr std::size_t kMinItemsToSplit = 8;

body::Part majority_part(const Items& items, std::span<const Index> members) {
  std::array<std::size_t, body::kPartCount> votes{};
  for (const Index i : members) ++votes[static_cast<int>(items.part[i])];
  return static_cast<body::Part>(std::max_element(votes.begin(), votes.end()) - votes.begin());
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

Refinement::Refinement(const engine::Context& context, const Items& items, Region region,
                       const RefineOptions& options)
    : context_(context), items_(items), region_(std::move(region)), options_(options) {
  for (const Index i : region_.items) {
    where_.push_back(items_.where[i]);
    weight_.push_back(items_.weight[i]);
  }
  recluster(region_.seeds);
}

double Refinement::worst_error() const {
  double worst = 0.0;
  for (const Cluster& c : clusters_)
    if (c.items.size() >= kMinItemsToSplit) worst = std::max(worst, c.error_m);
  return worst;
}

void Refinement::split_worst() {
  std::size_t worst = clusters_.size();
  for (std::size_t k = 0; k < clusters_.size(); ++k)
    if (clusters_[k].items.size() >= kMinItemsToSplit &&
        (worst == clusters_.size() || clusters_[k].error_m > clusters_[worst].error_m))
      worst = k;
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
  Clusters found = kmeans(context_, where_, weight_, std::move(centers), {options_.sigma_m, 50});
  std::vector<std::vector<Index>> members(found.centers.size());
  for (std::size_t i = 0; i < found.of_point.size(); ++i)
    members[found.of_point[i]].push_back(region_.items[i]);
  centers_ = std::move(found.centers);
  set_members(std::move(members));
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
  engine::parallel_for(context_, changed.size(), 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) fit(clusters_[changed[i]]);
  });
}

std::vector<Vec3> Refinement::skin_points(const Cluster& cluster) const {
  std::vector<Index> ids;
  for (const Index i : cluster.items)
    if (items_.is_skin[i]) ids.insert(ids.end(), items_.encloses[i].begin(), items_.encloses[i].end());
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  std::vector<Vec3> points;
  points.reserve(ids.size());
  for (const Index i : ids) points.push_back(items_.points[i]);
  return points;
}

void Refinement::fit(Cluster& cluster) const {
  std::vector<Vec3> points = skin_points(cluster);
  const std::size_t skin = points.size();
  for (const Index i : cluster.items)
    if (!items_.is_skin[i])
      for (const Index p : items_.encloses[i]) points.push_back(items_.points[p]);
  // A relative volume of 1e-4 moves a radius by a thirty-thousandth: far below every threshold mu.
  cluster.ellipsoid = mvee(points, {1e-4, options_.min_radius_m}).ellipsoid;
  points.resize(skin);
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
      for (std::size_t j = 0; items_.is_skin[i] && j < before.size(); ++j) {
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
