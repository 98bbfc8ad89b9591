// Accuracy of a proxy, measured by the exact signed distance to the mesh.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include <bodice/fitting/fit.hpp>
#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::fitting {

using geometry::Vec3;

/// Accuracy of the whole proxy and of each part.
struct Measured {
  FitAccuracy accuracy;
  std::array<Spread, body::kAllPartCount> gap_of_part{};
};

/// Samples the proxy's surface, the skin of the wanted parts, and the interior. Deterministic, parallel.
Measured measure(const engine::Context& context, const proxy::BodyProxy::Data& proxy, const LabeledSkin& skin,
                 const geometry::MeshDistance& distance, std::uint32_t parts);

/// Weighted mean, weighted 95th percentile and maximum of (value, weight) pairs; zeros if there are none.
Spread spread_of(std::vector<std::pair<double, double>> values);

}  // namespace bodice::fitting
