#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <bodice/engine/version.hpp>

namespace bodice::inline v0_1::geometry {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Index = std::uint32_t;
using Triangle = std::array<Index, 3>;

/// Stands for "no vertex" or "no triangle".
inline constexpr Index kNoIndex = ~Index{0};

/// An axis-aligned box; it is empty when low > high.
struct Box {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());

  bool empty() const { return (low.array() > high.array()).any(); }
  void extend(const Vec3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Vec3 size() const { return empty() ? Vec3(Vec3::Zero()) : Vec3(high - low); }
  Vec3 center() const { return 0.5 * (low + high); }
};

/// The least box that contains all points; empty without points.
inline Box bounding_box(std::span<const Vec3> points) {
  Box box;
  for (const Vec3& p : points) box.extend(p);
  return box;
}

}  // namespace bodice::geometry
