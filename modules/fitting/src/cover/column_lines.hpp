// The stretch of a line along y that an ellipsoid covers.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <bodice/geometry/ellipsoid.hpp>

#include "base/interior_grid.hpp"

namespace bodice::inline v0_1::fitting {

/// An ellipsoid prepared for intersection with lines along y.
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

/// The stretches of a row's columns that ellipsoids cover.
struct RowCover {
  /// A stretch of one column that one ellipsoid covers.
  struct Part {
    std::uint32_t ellipsoid;
    InteriorColumns::Stretch stretch;
  };
  std::vector<std::uint32_t> begin;  ///< nx + 1: where each column's parts begin
  std::vector<Part> parts;           ///< by column, then by ellipsoid; a column outside the body has none

  std::span<const Part> at(int i) const {
    return std::span(parts).subspan(
        begin[static_cast<std::size_t>(i)],
        begin[static_cast<std::size_t>(i) + 1] - begin[static_cast<std::size_t>(i)]);
  }
};

/// What the ellipsoids cover of row k.
RowCover cover_row(const InteriorColumns& columns, int k, std::span<const ColumnLine> lines);

/// Appends what remains of `wanted` without the `covered` stretches, which are sorted by their begin.
/// Remainders up to `shortest` are left out.
void subtract(const InteriorColumns::Stretch& wanted, std::span<const InteriorColumns::Stretch> covered,
              double shortest, std::vector<InteriorColumns::Stretch>& left);

}  // namespace bodice::fitting
