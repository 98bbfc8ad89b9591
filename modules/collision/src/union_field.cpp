#include "union_field.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace bodice::collision {

using geometry::Box;
using geometry::Vec3;

UnionField::UnionField(std::vector<geometry::Ellipsoid> shapes)
    : shapes_(std::move(shapes)),
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
    const Box box = boxes_[k] = geometry::bounding_box(shapes_[k]);
    Box& group = group_boxes_[k / kGroup];
    if (k % kGroup == 0) group = box;
    group.extend(box.low);
    group.extend(box.high);
    size_m_ = std::max({size_m_, box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff()});
  }
}

UnionField::Plane UnionField::plane(std::size_t k, const Vec3& p) const {
  const geometry::Ellipsoid& e = shapes_[k];
  const Vec3 u = (e.axes.transpose() * (p - e.center)).cwiseQuotient(e.radii);
  const Vec3 v = u.cwiseQuotient(e.radii);
  const double level = u.norm(), slope = v.norm();
  if (!(slope > 0.0)) return {-std::numeric_limits<double>::infinity(), Vec3::Zero()};
  return {level * (level - 1.0) / slope - kBoundRounding * size_m_, e.axes * (v / slope)};
}

Owner UnionField::owner(const Vec3& p, double below_m) const {
  Owner best;
  double least = below_m;
  visit_near(
      p, [&] { return least; },
      [&](std::size_t k) {
        const geometry::NearestPoint at = geometry::nearest_point(shapes_[k], p);
        if (at.signed_distance >= least) return;
        least = at.signed_distance;
        best = {static_cast<std::uint32_t>(k), at};
      });
  return best;
}

}  // namespace bodice::collision
