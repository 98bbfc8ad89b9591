// The tables of the relief tier: regularised least squares over the samples that each ellipsoid answers for.
#pragma once

#include <span>

#include "skin_samples.hpp"

namespace bodice::fitting {

/// Tables may use this much together with the ellipsoids.
inline constexpr std::size_t kReliefBytes = 128 * 1024;

/// The largest side whose tables keep a proxy of `ellipsoids` within kReliefBytes, 4..48; 0 if none does.
int relief_nodes_per_side(std::size_t ellipsoids);

/// Fills data.relief and data.texels for data.ellipsoids. Deterministic, parallel over ellipsoids.
void fit_relief(const engine::Context& context, std::span<const DistanceSample> samples, int nodes_per_side,
                proxy::BodyProxy::Data& data);

}  // namespace bodice::fitting
