#include "exact/near_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bodice::collision {

using geometry::ClosestPoint;
using geometry::Vec3;

/// Ellipsoids farther than this from a place neither own it below below_m nor blend into its owner.
double NearField::window_m() const {
  return below_m_ + bulge_m_ + blend_m_;
}

void NearField::expect(const Vec3& center, double radius_m) {
  center_ = center;
  radius_m_ = radius_m;
  candidate_count_ = 0;
  crowded_ = false;
  shortest_m_ = std::numeric_limits<double>::infinity();
  const double within_m = window_m() + radius_m;
  field_.visit_near(
      center, [&] { return within_m; },
      [&](std::size_t k, const UnionField::Plane& plane) {
        if (crowded_) return;
        shortest_m_ = std::min(shortest_m_, field_.shape(k).radii.minCoeff());
        crowded_ = candidate_count_ == kMost;
        if (!crowded_) candidates_[candidate_count_++] = {static_cast<std::uint32_t>(k), plane};
      });
}

void NearField::meet(std::uint32_t k, const Vec3& x) {
  const ClosestPoint at = geometry::closest_point(field_.shape(k), x);
  least_m_ = std::min(least_m_, at.signed_distance);
  // What lies beyond the blending is dropped when room is needed; the window only shrinks.
  if (foot_count_ == kMost) {
    const double last_m = least_m_ + blend_m_;
    const auto kept =
        std::remove_if(feet_, feet_ + foot_count_, [&](const Foot& f) { return f.distance_m > last_m; });
    foot_count_ = static_cast<int>(kept - feet_);
  }
  if (foot_count_ < kMost) feet_[foot_count_++] = {k, at.signed_distance, at.point, at.normal};
}

void NearField::collect_near(const Vec3& x) {
  double bounds[kMost];
  int first = 0;
  for (int i = 0; i < candidate_count_; ++i) {
    const UnionField::Plane& plane = candidates_[i].plane;
    bounds[i] = plane.distance_m + plane.normal.dot(x - center_);
    if (bounds[i] < bounds[first]) first = i;
  }
  if (candidate_count_ == 0 || bounds[first] >= window_m()) return;
  meet(candidates_[first].ellipsoid, x);
  for (int i = 0; i < candidate_count_; ++i)
    if (i != first && bounds[i] <= least_m_ + blend_m_) meet(candidates_[i].ellipsoid, x);
}

void NearField::collect_all(const Vec3& x) {
  field_.visit_near(
      x, [&] { return least_m_ + blend_m_; },
      [&](std::size_t k, const UnionField::Plane&) { meet(static_cast<std::uint32_t>(k), x); });
}

/// Newton on a convex function of the root, from above.
double NearField::smooth_root_m() const {
  double root = least_m_;
  for (int step = 0; step < kRootSteps; ++step) {
    double sum = -1.0, slope = 0.0;
    for (int i = 0; i < foot_count_; ++i) {
      const double u = std::max(0.0, 1.0 - (feet_[i].distance_m - root) / blend_m_);
      sum += u * u;
      slope += u;
    }
    if (!(sum > 0.0)) break;
    root -= 0.5 * blend_m_ * sum / slope;
  }
  return root;
}

/// Zero: the ellipsoid at this distance takes no part.
double NearField::weight_root(double distance_m, double root_m) const {
  if (blend_m_ > 0.0) return std::max(0.0, 1.0 - (distance_m - root_m) / blend_m_);
  return distance_m <= least_m_ ? 1.0 : 0.0;
}

ReliefSample NearField::share_of(const Foot& foot) const {
  if (relief_) return correct(field_, *relief_, foot.ellipsoid, {foot.point, foot.normal, foot.distance_m});
  return {foot.distance_m, foot.normal, foot.ellipsoid};
}

/// Relief averages the corrected distances of those that are nearest; a smooth union takes its root.
ReliefSample NearField::blend() {
  ReliefSample result{below_m_, Vec3::Zero(), kNoEllipsoid};
  const bool smooth = !relief_ && blend_m_ > 0.0;
  const double root_m = smooth ? smooth_root_m() : least_m_;
  double weights = 0.0, distance = 0.0;
  for (int i = 0; i < foot_count_; ++i) {
    const Foot& foot = feet_[i];
    const double root = weight_root(foot.distance_m, root_m);
    if (!(root > 0.0)) continue;
    const bool owns = foot.distance_m == least_m_ && result.owner == kNoEllipsoid;
    if (!bent() && !owns) continue;
    const double weight = smooth ? root : root * root;
    const ReliefSample one = share_of(foot);
    weights += weight;
    distance += weight * one.distance_m;
    result.gradient += weight * one.gradient;
    if (owns) result.owner = foot.ellipsoid;
    Share& slot = shares_[std::min(share_count_, kShares - 1)];
    slot = {weight, one};
    share_count_ = std::min(share_count_ + 1, kShares);
    if (owns) std::swap(shares_[0], slot);
  }
  if (result.owner == kNoEllipsoid) return result;
  result.distance_m = smooth ? root_m : distance / weights;
  result.gradient /= weights;
  return result;
}

ReliefSample NearField::at(const Vec3& x) {
  ++evaluations_;
  const double away_m = (x - center_).norm();
  if (!(away_m <= radius_m_)) expect(x, std::max(radius_m_, 0.5 * away_m));
  foot_count_ = share_count_ = 0;
  least_m_ = std::numeric_limits<double>::infinity();
  if (crowded_) {
    least_m_ = window_m();
    collect_all(x);
    if (foot_count_ == 0) return {below_m_, Vec3::Zero(), kNoEllipsoid};
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < foot_count_; ++i) least = std::min(least, feet_[i].distance_m);
    least_m_ = least;
  } else {
    collect_near(x);
  }
  return blend();
}

}  // namespace bodice::collision
