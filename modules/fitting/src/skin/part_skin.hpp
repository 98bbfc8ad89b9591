// The skin of one region as its task in tier solid uses it: no search tree, and of other regions only
// samples.
#pragma once

#include <vector>

#include <bodice/fitting/fit.hpp>

#include "cluster/refinement.hpp"
#include "skin/skin_samples.hpp"

namespace bodice::inline v0_1::fitting {

/// Even samples of one region's skin, and the balls that touch the skin at each.
struct PartSkin {
  std::vector<Vec3> normals;           ///< outward, unit
  std::vector<InscribedBall> balls;    ///< the largest balls inside
  std::vector<double> outer_radius_m;  ///< radii of the largest balls outside
};

/// About `count` samples of the whole skin, sorted into the regions. Deterministic, parallel.
std::vector<PartSkin> sample_parts(const engine::Context& context, const LabeledSkin& skin,
                                   const std::vector<Region>& regions, std::size_t count);

/// The samples that region r's ellipsoids are fitted to: its skin, points on either side of it with their
/// distance, and nearby skin of other regions as one-sided samples.
std::vector<DistanceSample> part_samples(const std::vector<PartSkin>& skins, std::size_t r, double stature_m);

}  // namespace bodice::fitting
