// The line between the legs.
#pragma once

#include <optional>

#include "coordinates/body_coordinates.hpp"

namespace bodice::inline v0_1::anatomy {

/// Equally spaced points of the line on which both feet are equally far, around its point nearest to a given
/// one: from the front of the body over the crotch to its back.
struct CrotchLine {
  static constexpr int kReach = 12;          ///< points on either side of the middle one
  static constexpr double kSpacing = 0.015;  ///< along the line, a fraction of the body size

  std::array<geometry::Vec3, 2 * kReach + 1> point{};

  const geometry::Vec3& at(int i) const { return point[static_cast<std::size_t>(kReach + i)]; }
};

/// Returns the crotch line, smoothed over about two spacings, or nothing where a hole or a weld cuts it. O(#V
/// + #F).
std::optional<CrotchLine> crotch_line(const Skin& skin, const BodyCoordinates& coordinates,
                                      const geometry::Vec3& middle);

}  // namespace bodice::anatomy
