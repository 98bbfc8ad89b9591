// Eq. (3) of bind.hpp: how deep the texels of the tables lie under other ellipsoids at rest.
#pragma once

#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/proxy/body_proxy.hpp>

namespace bodice::inline v0_1::binding {

struct Burial {
  std::vector<std::uint8_t> depth;  ///< #texels, in steps
  float step_m = 0.0f;
};

/// Depths count from the reach over which ellipsoids are blended. Deterministic, parallel. Some tens of
/// milliseconds for 60,000 texels.
Burial find_burial(const engine::Context& context, const proxy::BodyProxy& proxy);

}  // namespace bodice::binding
