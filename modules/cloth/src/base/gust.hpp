#pragma once

#include <cstdint>

#include <bodice/cloth/solver.hpp>

namespace bodice::inline v0_1::cloth {

/// The factor on the wind at a point and time, in [1 - gust, 1 + gust]: smooth value noise on a lattice that
/// the mean wind carries along (Taylor's frozen turbulence). A pure function of its arguments.
double gust_factor(const Environment& environment, std::uint64_t seed, double time_s,
                   const geometry::Vec3& world_point);

}  // namespace bodice::cloth
