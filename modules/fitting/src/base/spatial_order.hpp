#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::fitting {

/// The points' indices along a Morton curve through their bounding box (1024 cells a side, ties by index):
/// neighbors in the list are neighbors in space. O(n log n).
std::vector<std::uint32_t> spatial_order(std::span<const geometry::Vec3> points);

}  // namespace bodice::fitting
