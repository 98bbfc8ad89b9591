#include "union_field.hpp"

#include <algorithm>
#include <limits>

namespace bodice::collision {

using geometry::Box;
using geometry::Vec3;

UnionField::UnionField(std::vector<geometry::Ellipsoid> shapes)
    : shapes_(std::move(shapes)), boxes_(shapes_.size()) {
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
    size_m_ = std::max({size_m_, box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff()});
  }
}

double UnionField::lower_bound(std::size_t k, const Vec3& p) const {
  const Box& box = boxes_[k];
  const Vec3 outside = (box.low - p).cwiseMax(p - box.high).cwiseMax(0.0);
  const double distance = outside.norm();
  return distance > 0.0 ? distance : -std::numeric_limits<double>::infinity();
}

Owner UnionField::owner(const Vec3& p, double below_m) const {
  Owner best;
  double least = below_m;
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    if (lower_bound(k, p) >= least) continue;
    const geometry::NearestPoint at = geometry::nearest_point(shapes_[k], p);
    if (at.signed_distance >= least) continue;
    least = at.signed_distance;
    best = {static_cast<std::uint32_t>(k), at};
  }
  return best;
}

}  // namespace bodice::collision
