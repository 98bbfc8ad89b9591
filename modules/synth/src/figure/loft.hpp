// A limb as an implicit solid: cross-sections of four elliptic quarters, lofted along a straight axis.
#pragma once

#include <array>
#include <vector>

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::synth {

using geometry::Vec3;

/// One cross-section. `side` is the radius along +u and -u, `front` along +v, `back` along -v; (u, v) is the
/// offset of its center from the axis.
struct Section {
  double s = 0.0;  ///< position along the axis
  double side = 0.0, front = 0.0, back = 0.0;
  double u = 0.0, v = 0.0;
};

/// The axis of a loft, and the directions that its sections are measured in. The three are orthonormal.
struct LoftFrame {
  Vec3 origin;  ///< where s is zero
  Vec3 along, u, v;
};

class Loft {
 public:
  /// Makes a loft. The sections are sorted by s; a single section makes an ellipsoid. The ends are rounded
  /// over `near_cap` and `far_cap`. `squareness` 0 gives ellipses, 1 fourth-power curves with rounder
  /// corners.
  Loft(const LoftFrame& frame, std::vector<Section> sections, double near_cap, double far_cap,
       double squareness = 0.0);

  /// Approximately the distance to the surface, negative inside. It is C1 except on the axis.
  double value(const Vec3& p) const;

  /// The coordinate of p along the axis, not clamped.
  double along_of(const Vec3& p) const { return (p - frame_.origin).dot(frame_.along); }

  const Vec3& bound_center() const { return bound_center_; }
  double bound_radius() const { return bound_radius_; }

 private:
  using Row = std::array<double, 5>;  // side, front, back, u, v
  Row row_at(double s) const;
  void fit_cubics(const std::vector<Section>& sections);
  void find_bound(const std::vector<Section>& sections);

  LoftFrame frame_;
  double near_cap_, far_cap_, squareness_;
  std::vector<double> knots_;
  std::vector<std::array<Row, 4>> cubics_;  // one a pair of knots, in powers of (s - knot)
  Vec3 bound_center_ = Vec3::Zero();
  double bound_radius_ = 0.0;
};

}  // namespace bodice::synth
