// A tape around a cut of the body.
#pragma once

#include <span>
#include <vector>

#include <bodice/body/part.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::anatomy {

/// A plane with axes in it. A tape runs around `normal`, from `right` over the back to `left`.
struct CutPlane {
  geometry::Vec3 origin, normal;
  geometry::Vec3 left, front;  ///< unit, in the plane
};

/// A point of a cut: its distances to the left and to the front of the plane's origin, meters.
struct CutPoint {
  double left = 0.0, front = 0.0;
};

/// Where a plane cuts the skin of some parts: the points of the cut, by rising distance to the left.
std::vector<CutPoint> cut(const geometry::TriMesh& skin, std::span<const body::Part> part,
                          std::span<const body::Part> of_parts, const CutPlane& plane);

/// A tape that bridges the hollows of a cut: its convex hull.
class Tape {
 public:
  explicit Tape(const std::vector<CutPoint>& sorted);

  bool found() const { return back_.size() > 1 && front_.size() > 1; }
  double girth() const;
  /// Length of what lies behind the middle between the tape's foremost and rearmost points.
  double back_length() const;
  double half_width() const { return 0.5 * (back_.back().left - back_.front().left); }
  /// How far to the front the tape lies at this distance to the left.
  double front_at(double left) const;

 private:
  std::vector<CutPoint> back_, front_;  ///< both from right to left
};

}  // namespace bodice::anatomy
