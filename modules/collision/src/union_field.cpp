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
  struct Bound {
    std::size_t k;
    double m;
  };
  constexpr int kMost = 64;
  Bound bounds[kMost];
  int count = 0, first = 0;
  Owner best;
  double least = below_m;
  const auto meet = [&](std::size_t k) {
    const geometry::NearestPoint at = geometry::nearest_point(shapes_[k], p);
    const bool tie = at.signed_distance == least && best.ellipsoid != kNoEllipsoid && k < best.ellipsoid;
    if (!(at.signed_distance < least || tie)) return;
    least = at.signed_distance;
    best = {static_cast<std::uint32_t>(k), at};
  };
  visit_near(
      p, [&] { return least; },
      [&](std::size_t k, double bound) {
        if (count == kMost) return meet(k);
        bounds[count] = {k, bound};
        if (bound < bounds[first].m) first = count;
        ++count;
      });
  // That of the least bound leaves few others.
  if (count > 0) meet(bounds[first].k);
  for (int i = 0; i < count; ++i)
    if (i != first && bounds[i].m <= least) meet(bounds[i].k);
  return best;
}

}  // namespace bodice::collision
