// Which stretch of a line along y an ellipsoid covers.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <bodice/geometry/ellipsoid.hpp>

#include "base/interior_grid.hpp"

namespace bodice::fitting {

/// An ellipsoid made ready for lines along y.
struct ColumnLine {
  geometry::Box box;
  geometry::Mat3 whiten;
  geometry::Vec3 center;

  explicit ColumnLine(const geometry::Ellipsoid& e)
      : box(geometry::bounding_box(e)),
        whiten(e.radii.cwiseInverse().asDiagonal() * e.axes.transpose()),
        center(e.center) {}

  /// The stretch of the line through (x, z) inside the ellipsoid; empty (first > second) if there is none.
  InteriorColumns::Stretch inside(double x, double z) const {
    constexpr InteriorColumns::Stretch kNone{1.0, 0.0};
    const geometry::Vec3 along = whiten.col(1);
    const geometry::Vec3 from = whiten * geometry::Vec3(x - center.x(), 0.0, z - center.z());
    const double a = along.squaredNorm(), b = from.dot(along), c = from.squaredNorm() - 1.0;
    const double root = b * b - a * c;
    if (!(root > 0.0)) return kNone;
    const double half = std::sqrt(root);
    return {center.y() + (-b - half) / a, center.y() + (-b + half) / a};
  }
};

/// Which ellipsoids cover which stretches of a row's columns.
struct RowCover {
  struct Part {
    std::uint32_t ellipsoid;
    InteriorColumns::Stretch stretch;
  };
  std::vector<std::uint32_t> begin;  ///< nx + 1, into parts
  std::vector<Part> parts;           ///< of a column by ellipsoid; none where the body is not

  std::span<const Part> at(int i) const {
    return std::span(parts).subspan(
        begin[static_cast<std::size_t>(i)],
        begin[static_cast<std::size_t>(i) + 1] - begin[static_cast<std::size_t>(i)]);
  }
};

/// Of row k.
RowCover cover_row(const InteriorColumns& columns, int k, std::span<const ColumnLine> lines);

/// Appends what `wanted` has that none of the `covered` stretches (sorted by their begin) has, where it is
/// longer than `shortest`.
void subtract(const InteriorColumns::Stretch& wanted, std::span<const InteriorColumns::Stretch> covered,
              double shortest, std::vector<InteriorColumns::Stretch>& left);

}  // namespace bodice::fitting
