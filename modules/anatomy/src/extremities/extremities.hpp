// The five extremities of a body, in any pose: distances along the skin do not depend on the pose.
#pragma once

#include <array>
#include <optional>

#include "skin/skin.hpp"

namespace bodice::inline v0_1::anatomy {

/// Head, hands and feet before left and right are known.
enum Extremity { kHead, kHandA, kHandB, kFootA, kFootB };
inline constexpr int kExtremityCount = 5;

/// The tips of head, hands and feet. Hand A is on the side of foot A; which of the two sides is left is
/// decided elsewhere.
struct Extremities {
  std::array<geometry::Index, kExtremityCount> vertex{};
  std::array<geodesic::Field, kExtremityCount> field;  ///< distance of every vertex from each end, meters
  double mahalanobis = 0.0;  ///< of their distances to those of a body; below 1 is good
  double side_margin = 0.0;  ///< how clearly hands and feet pair, relative to the body's size

  float between(Extremity a, Extremity b) const { return field[a][vertex[b]]; }
  float hands_apart() const { return between(kHandA, kHandB); }
  float feet_apart() const { return between(kFootA, kFootB); }
  float head_to_feet() const { return 0.5F * (between(kHead, kFootA) + between(kHead, kFootB)); }
};

/// Empty when the skin has no five extremities at the distances that a body's have.
std::optional<Extremities> find_extremities(const engine::Context& context, const Skin& skin);

}  // namespace bodice::anatomy
