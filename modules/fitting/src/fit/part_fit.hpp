#pragma once

#include "fit/measure.hpp"

namespace bodice::inline v0_1::fitting {

/// The ellipsoids of a draft, with the E_j of their clusters where the tier has clusters.
struct FittedEllipsoids {
  std::vector<proxy::ProxyEllipsoid> ellipsoids;
  std::vector<double> cluster_error_m;  ///< one an ellipsoid, or empty
};

/// The report's line for each wanted part that has skin. Radial errors follow eq. (6) over the vertices that
/// are nearest to each ellipsoid along their ray, so that every tier is measured alike.
std::vector<PartFit> part_fits(const engine::Context& context, const LabeledSkin& skin,
                               const FittedEllipsoids& fitted, const Measured& measured, std::uint32_t parts);

}  // namespace bodice::fitting
