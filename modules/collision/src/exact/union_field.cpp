#include "exact/union_field.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace bodice::inline v0_1::collision {

using geometry::Box;
using geometry::Vec3;

UnionField::UnionField(std::vector<geometry::Ellipsoid> shapes)
    : shapes_(std::move(shapes)),
      to_unit_(shapes_.size()),
      boxes_(shapes_.size()),
      group_boxes_((shapes_.size() + kGroup - 1) / kGroup) {
  bound();
}

void UnionField::update(const std::vector<geometry::Ellipsoid>& shapes) {
  shapes_ = shapes;
  bound();
}

void UnionField::bound() {
  size_m_ = 0.0;
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    to_unit_[k] = shapes_[k].radii.cwiseInverse().asDiagonal() * shapes_[k].axes.transpose();
    const Box box = boxes_[k] = geometry::bounding_box(shapes_[k]);
    Box& group = group_boxes_[k / kGroup];
    if (k % kGroup == 0) group = box;
    group.extend(box.low);
    group.extend(box.high);
    size_m_ = std::max({size_m_, box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff()});
  }
}

UnionField::Plane UnionField::plane(std::size_t k, const Vec3& p) const {
  const Vec3 u = to_unit_[k] * (p - shapes_[k].center);
  const Vec3 gradient = to_unit_[k].transpose() * u;
  const double level = u.norm(), slope = gradient.norm();
  if (!(slope > 0.0)) return {-std::numeric_limits<double>::infinity(), Vec3::Zero()};
  return {level * (level - 1.0) / slope - kBoundRounding * size_m_, gradient / slope};
}

/// Distance to the ball inside the ellipsoid, which bounds the distance from above.
double UnionField::upper_bound(std::size_t k, const Vec3& p) const {
  const geometry::Ellipsoid& e = shapes_[k];
  return (p - e.center).norm() - e.radii.minCoeff() + kBoundRounding * size_m_;
}

Owner UnionField::owner(const Vec3& p, double below_m) const {
  struct Bound {
    std::size_t k;
    double m;
  };
  constexpr int kCapacity = 64;
  Bound bounds[kCapacity];
  int count = 0, first = 0;
  Owner best;
  double least = below_m, within = below_m;
  const auto evaluate = [&](std::size_t k) {
    const geometry::ClosestPoint at = geometry::closest_point(shapes_[k], p);
    const bool tie = at.signed_distance == least && best.ellipsoid != kNoEllipsoid && k < best.ellipsoid;
    if (!(at.signed_distance < least || tie)) return;
    least = at.signed_distance;
    within = std::min(within, least);
    best = {static_cast<std::uint32_t>(k), at};
  };
  visit_near(
      p, [&] { return within; },
      [&](std::size_t k, const Plane& bound) {
        if (count == kCapacity) return evaluate(k);
        within = std::min(within, upper_bound(k, p));
        bounds[count] = {k, bound.distance_m};
        if (bound.distance_m < bounds[first].m) first = count;
        ++count;
      });
  // The candidate of the least bound leaves few others to evaluate.
  if (count > 0) evaluate(bounds[first].k);
  for (int i = 0; i < count; ++i)
    if (i != first && bounds[i].m <= least) evaluate(bounds[i].k);
  return best;
}

}  // namespace bodice::collision
