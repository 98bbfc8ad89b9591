#pragma once

#include <vector>

#include "skin/free_skin.hpp"

namespace bodice::fitting {

/// Points deeper inside the skin than `depth_m` that the proxy's tables report outside, or less than
/// `margin_m` inside. Only a cell of a table whose nodes cut that deep can do so, so each such cell is probed
/// at a few depths: holes that fit between the samples of any grid are found where they arise.
/// Deterministic, parallel.
std::vector<Vec3> find_holes(const engine::Context& context, const FreeSkin& skin,
                             const proxy::BodyProxy::Data& proxy, double depth_m, double margin_m);

}  // namespace bodice::fitting
