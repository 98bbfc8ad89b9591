#include "exact/near_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bodice::inline v0_1::collision {

using geometry::ClosestPoint;
using geometry::Vec3;

/// An ellipsoid farther than this from a point neither owns it at a distance below below_m_ nor blends with
/// its owner. With burial an owner's score may be farther above its distance.
double NearField::window_m() const {
  return below_m_ + bulge_m_ + blend_m_ + buried_m_;
}

void NearField::prepare(const Vec3& center, double radius_m) {
  center_ = center;
  radius_m_ = radius_m;
  candidate_count_ = 0;
  overflow_ = false;
  shortest_m_ = std::numeric_limits<double>::infinity();
  const double within_m = window_m() + radius_m;
  field_.visit_near(
      center, [&] { return within_m; },
      [&](std::size_t k, const UnionField::Plane& plane) {
        if (overflow_) return;
        shortest_m_ = std::min(shortest_m_, field_.shape(k).radii.minCoeff());
        overflow_ = candidate_count_ == kCapacity;
        if (!overflow_) candidates_[candidate_count_++] = {static_cast<std::uint32_t>(k), plane};
      });
}

void NearField::evaluate(std::uint32_t k, const Vec3& x) {
  const ClosestPoint at = geometry::closest_point(field_.shape(k), x);
  const double score_m = relief_ ? score_of(field_, *relief_, k, at) : at.signed_distance;
  least_m_ = std::min(least_m_, score_m);
  // A full list drops what lies beyond the blend radius of the least distance so far; that distance only
  // falls, so nothing is lost.
  if (evaluated_count_ == kCapacity) {
    const double last_m = least_m_ + blend_m_;
    const auto kept = std::remove_if(evaluated_, evaluated_ + evaluated_count_,
                                     [&](const Evaluated& f) { return f.score_m > last_m; });
    evaluated_count_ = static_cast<int>(kept - evaluated_);
  }
  if (evaluated_count_ < kCapacity)
    evaluated_[evaluated_count_++] = {k, at.signed_distance, score_m, at.point, at.normal};
}

void NearField::evaluate_candidates(const Vec3& x) {
  double bounds[kCapacity];
  int first = 0;
  for (int i = 0; i < candidate_count_; ++i) {
    const UnionField::Plane& plane = candidates_[i].plane;
    bounds[i] = plane.distance_m + plane.normal.dot(x - center_);
    if (bounds[i] < bounds[first]) first = i;
  }
  if (candidate_count_ == 0 || bounds[first] >= window_m()) return;
  evaluate(candidates_[first].ellipsoid, x);
  for (int i = 0; i < candidate_count_; ++i)
    if (i != first && bounds[i] <= least_m_ + blend_m_) evaluate(candidates_[i].ellipsoid, x);
}

void NearField::evaluate_all(const Vec3& x) {
  field_.visit_near(
      x, [&] { return least_m_ + blend_m_; },
      [&](std::size_t k, const UnionField::Plane&) { evaluate(static_cast<std::uint32_t>(k), x); });
}

/// Newton's method from above on a convex function of the root.
double NearField::smooth_root_m() const {
  double root = least_m_;
  for (int step = 0; step < kRootSteps; ++step) {
    double sum = -1.0, slope = 0.0;
    for (int i = 0; i < evaluated_count_; ++i) {
      const double u = std::max(0.0, 1.0 - (evaluated_[i].distance_m - root) / blend_m_);
      sum += u * u;
      slope += u;
    }
    if (!(sum > 0.0)) break;
    root -= 0.5 * blend_m_ * sum / slope;
  }
  return root;
}

/// Square root of an ellipsoid's blending weight; zero if it takes no part.
double NearField::weight_root(double score_m, double root_m) const {
  if (blend_m_ > 0.0) return std::max(0.0, 1.0 - (score_m - root_m) / blend_m_);
  return score_m <= least_m_ ? 1.0 : 0.0;
}

ReliefSample NearField::corrected_sample(const Evaluated& evaluated) const {
  if (relief_)
    return correct(field_, *relief_, evaluated.ellipsoid,
                   {evaluated.point, evaluated.normal, evaluated.distance_m});
  return {evaluated.distance_m, evaluated.normal, evaluated.ellipsoid};
}

/// Relief averages the corrected distances of the nearest ellipsoids; the smooth union takes its root.
ReliefSample NearField::blend() {
  ReliefSample result{below_m_, Vec3::Zero(), kNoEllipsoid};
  const bool smooth = !relief_ && blend_m_ > 0.0;
  const double root_m = smooth ? smooth_root_m() : least_m_;
  double weights = 0.0, distance = 0.0;
  for (int i = 0; i < evaluated_count_; ++i) {
    const Evaluated& evaluated = evaluated_[i];
    const double root = weight_root(evaluated.score_m, root_m);
    if (!(root > 0.0)) continue;
    const bool owns = evaluated.score_m == least_m_ && result.owner == kNoEllipsoid;
    if (!nonconvex() && !owns) continue;
    const double weight = smooth ? root : root * root;
    const ReliefSample one = corrected_sample(evaluated);
    weights += weight;
    distance += weight * one.distance_m;
    result.gradient += weight * one.gradient;
    if (owns) result.owner = evaluated.ellipsoid;
    Term& slot = terms_[std::min(term_count_, kMaxTerms - 1)];
    slot = {weight, one};
    term_count_ = std::min(term_count_ + 1, kMaxTerms);
    if (owns) std::swap(terms_[0], slot);
  }
  if (result.owner == kNoEllipsoid) return result;
  result.distance_m = smooth ? root_m : distance / weights;
  result.gradient /= weights;
  return result;
}

ReliefSample NearField::at(const Vec3& x) {
  ++evaluations_;
  const double away_m = (x - center_).norm();
  if (!(away_m <= radius_m_)) prepare(x, std::max(radius_m_, 0.5 * away_m));
  evaluated_count_ = term_count_ = 0;
  least_m_ = std::numeric_limits<double>::infinity();
  if (overflow_) {
    least_m_ = window_m();
    evaluate_all(x);
    if (evaluated_count_ == 0) return {below_m_, Vec3::Zero(), kNoEllipsoid};
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < evaluated_count_; ++i) least = std::min(least, evaluated_[i].score_m);
    least_m_ = least;
  } else {
    evaluate_candidates(x);
  }
  return blend();
}

}  // namespace bodice::collision
