#pragma once

#include "fit/measure.hpp"

namespace bodice::fitting {

/// The report's line for each wanted part that has skin. Radial errors follow eq. (6) over the vertices that
/// are nearest to each ellipsoid along their ray, so that every tier is reported by the same measure.
std::vector<PartFit> part_fits(const engine::Context& context, const LabeledSkin& skin,
                               std::span<const proxy::ProxyEllipsoid> ellipsoids, const Measured& measured,
                               std::uint32_t parts);

}  // namespace bodice::fitting
