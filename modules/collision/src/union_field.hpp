// The union of a proxy's ellipsoids in double precision: the exact side of the module, which judges what the
// float kernels leave open.
#pragma once

#include <cstdint>
#include <vector>

#include <bodice/collision/collider.hpp>
#include <bodice/geometry/ellipsoid.hpp>

namespace bodice::collision {

/// The ellipsoid with the least signed distance to a point.
struct Owner {
  std::uint32_t ellipsoid = kNoEllipsoid;
  geometry::NearestPoint at;  ///< on the ellipsoid itself, without margin
};

/// Immutable once built.
class UnionField {
 public:
  /// Takes over the shapes, given in the local frame.
  explicit UnionField(std::vector<geometry::Ellipsoid> shapes);
  /// Other shapes of the same number; allocates nothing.
  void update(const std::vector<geometry::Ellipsoid>& shapes);

  std::size_t size() const { return shapes_.size(); }
  /// Largest coordinate of the union's box: what rounding errors are relative to.
  double size_m() const { return size_m_; }
  const geometry::Ellipsoid& shape(std::size_t k) const { return shapes_[k]; }
  const geometry::Box& box(std::size_t k) const { return boxes_[k]; }

  /// Never above the signed distance of ellipsoid k; minus infinity inside its box.
  double lower_bound(std::size_t k, const geometry::Vec3& p) const;

  /// argmin_k d_k(p) among those with d_k(p) < `below_m`; no ellipsoid if there is none. The lowest index
  /// wins a tie.
  Owner owner(const geometry::Vec3& p, double below_m) const;

 private:
  void bound();

  std::vector<geometry::Ellipsoid> shapes_;
  std::vector<geometry::Box> boxes_;
  double size_m_ = 0.0;
};

}  // namespace bodice::collision
