#include "stand_in.hpp"

#include <algorithm>
#include <numeric>

#include <bodice/fitting/kmeans.hpp>
#include <bodice/fitting/mvee.hpp>

namespace paper_bench {

using bodice::geometry::Ellipsoid;
using bodice::geometry::Vec3;

namespace {

constexpr double kVolumeTolerance = 1e-4;  // tolerance of enclosing ellipsoids, as in bodice::fitting
constexpr std::size_t kLeastPoints = 8;    // a cluster with fewer is not split, as in bodice::fitting

/// A clustering with the ellipsoids and the errors of its clusters.
struct State {
  std::vector<Vec3> centers;
  std::vector<Ellipsoid> ellipsoids;
  std::vector<double> error_m;
  std::vector<std::size_t> points;
  double worst_m = 0.0;
};

/// The state of the method, and its two steps: split and cluster again.
class StandIn {
 public:
  StandIn(const bodice::engine::Context& context, std::span<const Vec3> skin, double min_radius_m)
      : context_(context), skin_(skin), min_radius_m_(min_radius_m) {
    const Vec3 sum = std::accumulate(skin.begin(), skin.end(), Vec3(Vec3::Zero()));
    state_ = cluster({sum / static_cast<double>(skin.size())});
  }

  /// Adds an ellipsoid; false if none can be split.
  bool split(int most_tries) {
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < state_.centers.size(); ++k)
      if (state_.points[k] >= kLeastPoints) order.push_back(k);
    std::ranges::stable_sort(order, std::greater{}, [&](std::size_t k) { return state_.error_m[k]; });
    State best;
    int tried = 0;
    for (const std::size_t k : order) {
      if (tried == most_tries) break;
      State next = cluster(split_centers(k));
      if (next.centers.size() <= state_.centers.size()) continue;  // a cluster lost all its points
      const bool better = next.worst_m < state_.worst_m;
      if (tried == 0 || next.worst_m < best.worst_m) best = std::move(next);
      ++tried;
      if (better) break;
    }
    if (tried == 0) return false;
    state_ = std::move(best);
    fit_.backtracks += tried - 1;
    return true;
  }

  std::size_t count() const { return state_.ellipsoids.size(); }
  StandInFit finish() {
    fit_.ellipsoids = state_.ellipsoids;
    return fit_;
  }

 private:
  std::vector<Vec3> split_centers(std::size_t k) const {
    const Ellipsoid& e = state_.ellipsoids[k];
    int longest = 0;
    e.radii.maxCoeff(&longest);
    const Vec3 end = e.radii[longest] * e.axes.col(longest);
    std::vector<Vec3> centers = state_.centers;
    centers[k] = e.center - end;
    centers.push_back(e.center + end);
    return centers;
  }

  State cluster(std::vector<Vec3> centers) {
    const auto found = bodice::fitting::kmeans(context_, skin_, {}, std::move(centers), {});
    std::vector<std::vector<Vec3>> members(found.centers.size());
    for (std::size_t i = 0; i < skin_.size(); ++i) members[found.of_point[i]].push_back(skin_[i]);
    State state;
    for (std::size_t k = 0; k < members.size(); ++k) {
      if (members[k].empty()) continue;
      state.centers.push_back(found.centers[k]);
      state.points.push_back(members[k].size());
      state.ellipsoids.push_back(
          bodice::fitting::mvee(members[k], {kVolumeTolerance, min_radius_m_}).ellipsoid);
      state.error_m.push_back(radial_error(state.ellipsoids.back(), members[k]));
      state.worst_m = std::max(state.worst_m, state.error_m.back());
    }
    return state;
  }

  const bodice::engine::Context& context_;
  std::span<const Vec3> skin_;
  double min_radius_m_;
  State state_;
  StandInFit fit_;
};

}  // namespace

double radial_error(const Ellipsoid& ellipsoid, std::span<const Vec3> points) {
  double sum = 0.0;
  for (const Vec3& p : points) sum += (p - bodice::geometry::radial_projection(ellipsoid, p)).norm();
  return points.empty() ? 0.0 : sum / static_cast<double>(points.size());
}

StandInFit fit_stand_in(const bodice::engine::Context& context, std::span<const Vec3> skin, std::size_t count,
                        int most_tries, double min_radius_m) {
  if (skin.empty()) return {};
  StandIn stand_in(context, skin, min_radius_m);
  while (stand_in.count() < count && stand_in.split(most_tries)) {
  }
  return stand_in.finish();
}

}  // namespace paper_bench
