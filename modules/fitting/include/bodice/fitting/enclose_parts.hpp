// The proxy that is made quickest: one enclosing ellipsoid a part.
#pragma once

#include <cstdint>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice/proxy/body_proxy.hpp>

namespace bodice::inline v0_1::fitting {

/// Makes a proxy of tier solid with one ellipsoid for each wanted part that has skin. The ellipsoid encloses
/// every triangle that has a corner in the part, so that the union holds the whole skin of these parts. Its
/// gap is centimeters: it serves until a better proxy is there. parts  a bit for each wanted part, see
/// kAllParts. Fails as fit() does. Deterministic for any worker count. O(#V) a part, parts in parallel: 1 ms
/// for 10k vertices, 20 ms for 200k. Based on: the paper, figure 8 (a). Differs: triangles across a border
/// are enclosed by both parts.
engine::Result<proxy::BodyProxy> enclose_parts(const engine::Context& context, const LabeledSkin& skin,
                                               std::uint32_t parts);

}  // namespace bodice::fitting
