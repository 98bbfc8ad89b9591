// The cost model that FitOptions::budget_us is measured by.
#pragma once

#include <bodice/proxy/body_proxy.hpp>

namespace bodice::inline v0_1::fitting {

/// Time that a query of 10,000 particles takes by the cost model, in microseconds. The model is a formula and
/// no measurement, so that fits repeat. Conditions: particles within 30 mm of the skin, in Morton order,
/// without a workspace (one makes later queries a quarter faster), against 16 or more ellipsoids, on one
/// thread of a 2.5 GHz server with AVX-512. Accuracy: bodies lie within a fifth of it there; the tier paper
/// takes up to twice as long, because its ellipsoids overlap more. Another machine is slower or faster by
/// about the same factor for every proxy.
double predicted_frame_us(proxy::Tier tier, int ellipsoids);

}  // namespace bodice::fitting
