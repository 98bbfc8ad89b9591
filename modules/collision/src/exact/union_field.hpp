// The union of a proxy's ellipsoids in double precision. It is the base of the exact side, which handles what
// the float kernels leave open.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include <bodice/collision/collider.hpp>
#include <bodice/geometry/ellipsoid.hpp>

namespace bodice::inline v0_1::collision {

/// The ellipsoid with the least signed distance to a point, and its closest point.
struct Owner {
  std::uint32_t ellipsoid = kNoEllipsoid;
  geometry::ClosestPoint at;  ///< on the ellipsoid itself, margin not subtracted
};

/// Union distance of the ellipsoids, with boxes and bounds to find the few that matter. Thread-safe between
/// updates.
class UnionField {
 public:
  /// Takes the shapes, given in the local frame.
  explicit UnionField(std::vector<geometry::Ellipsoid> shapes);
  /// Replaces the shapes by as many others; allocates nothing.
  void update(const std::vector<geometry::Ellipsoid>& shapes);

  std::size_t size() const { return shapes_.size(); }
  /// Largest coordinate of the union's box, meters; rounding errors are relative to it.
  double size_m() const { return size_m_; }
  const geometry::Ellipsoid& shape(std::size_t k) const { return shapes_[k]; }
  const geometry::Box& box(std::size_t k) const { return boxes_[k]; }
  const std::vector<geometry::Box>& boxes() const { return boxes_; }

  /// A plane that ellipsoid k lies behind: d(x) >= distance_m + normal . (x - p) for every x. The bound is of
  /// first order (simd/ellipsoid/bound-inl.hpp) and costs a tenth of the closest point.
  struct Plane {
    double distance_m;
    geometry::Vec3 normal;
  };
  Plane plane(std::size_t k, const geometry::Vec3& p) const;

  /// Calls visit(k, plane(k, p)), by rising k, for each ellipsoid that bounds cannot prove to be farther from
  /// p than limit(). The limit may shrink meanwhile.
  template <class Limit, class Visit>
  void visit_near(const geometry::Vec3& p, Limit&& limit, Visit&& visit) const {
    for (std::size_t group = 0; group < group_boxes_.size(); ++group) {
      if (beyond(group_boxes_[group], p, limit())) continue;
      const std::size_t end = std::min((group + 1) * kGroup, shapes_.size());
      for (std::size_t k = group * kGroup; k < end; ++k) {
        if (beyond(boxes_[k], p, limit())) continue;
        const Plane bound = plane(k, p);
        if (!(bound.distance_m > limit())) visit(k, bound);
      }
    }
  }

  /// The owner of p, argmin_k d_k(p), if d_k(p) < `below_m`; otherwise no ellipsoid. The lowest index wins a
  /// tie.
  Owner owner(const geometry::Vec3& p, double below_m) const;

 private:
  static constexpr std::size_t kGroup = 16;  ///< the shapes' order makes a group neighbors in space
  static constexpr double kBoundRounding = 1e-12;

  /// Whether p is outside of the box and farther from it than the limit, which may be negative.
  static bool beyond(const geometry::Box& box, const geometry::Vec3& p, double limit_m) {
    const double squared = (box.low - p).cwiseMax(p - box.high).cwiseMax(0.0).squaredNorm();
    return squared > 0.0 && (limit_m < 0.0 || squared > limit_m * limit_m);
  }
  double upper_bound(std::size_t k, const geometry::Vec3& p) const;
  void bound();

  std::vector<geometry::Ellipsoid> shapes_;
  std::vector<geometry::Mat3> to_unit_;  ///< maps each shape to the unit ball
  std::vector<geometry::Box> boxes_, group_boxes_;
  double size_m_ = 0.0;
};

}  // namespace bodice::collision
