#pragma once

#include <vector>

#include "skin/free_skin.hpp"

namespace bodice::inline v0_1::fitting {

/// Points deeper inside the skin than `depth_m` that the proxy's tables report outside, or less than
/// `margin_m` inside. Only a cell with nodes that cut that deep can cause such a hole. Each such cell is
/// probed at a few depths, so that holes that fit between the samples of any grid are found. Deterministic,
/// parallel.
std::vector<Vec3> find_holes(const engine::Context& context, const FreeSkin& skin,
                             const proxy::BodyProxy::Data& proxy, double depth_m, double margin_m);

}  // namespace bodice::fitting
