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
  /// Distance of every vertex from each extremity, meters.
  std::array<geodesic::Field, kExtremityCount> field;
  /// How far their mutual distances are from those of known bodies (Mahalanobis); below 1 is good.
  double mahalanobis = 0.0;
  /// Difference of the two pairings of hands and feet, as a share of the body size.
  double side_margin = 0.0;

  float between(Extremity a, Extremity b) const { return field[a][vertex[b]]; }
  float hands_apart() const { return between(kHandA, kHandB); }
  float feet_apart() const { return between(kFootA, kFootB); }
  float head_to_feet() const { return 0.5F * (between(kHead, kFootA) + between(kHead, kFootB)); }
};

/// Finds the extremities. Empty if the skin has no five vertices with mutual distances like those of a body.
/// Cost: about eight distance fields.
std::optional<Extremities> find_extremities(const engine::Context& context, const Skin& skin);

}  // namespace bodice::anatomy
