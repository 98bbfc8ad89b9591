// The quickest proxy that a body has: one enclosing ellipsoid a part.
#pragma once

#include <cstdint>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice/proxy/body_proxy.hpp>

namespace bodice::fitting {

/// Encloses every triangle that has a corner in a part, for each wanted part that has any, so that the union
/// holds the whole skin: tier solid, loose (centimeters), for the time until a better one is there. Fails as
/// fit() does. Parts in parallel, O(#vertices) each: about 1 ms for 10k vertices, 20 ms for 200k.
/// Based on: the paper, figure 8 (a), one ellipsoid a part. Differs: encloses the triangles across borders.
engine::Result<proxy::BodyProxy> enclose_parts(const engine::Context& context, const LabeledSkin& skin,
                                               std::uint32_t parts);

}  // namespace bodice::fitting
