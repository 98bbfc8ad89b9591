// What a part's own task of the solid tier knows of the skin: no search tree, no other part.
#pragma once

#include <vector>

#include <bodice/fitting/fit.hpp>

#include "cluster/refinement.hpp"
#include "skin/skin_samples.hpp"

namespace bodice::fitting {

/// Even samples of one region's skin and the balls that touch it there.
struct PartSkin {
  std::vector<Vec3> normals;           ///< outward, unit
  std::vector<InscribedBall> balls;    ///< inside
  std::vector<double> outer_radius_m;  ///< of the largest ball outside
};

/// About `count` samples of the whole skin, sorted into the regions. Deterministic, parallel.
std::vector<PartSkin> sample_parts(const engine::Context& context, const LabeledSkin& skin,
                                   const std::vector<Region>& regions, std::size_t count);

/// What region r's ellipsoids are fitted to: its skin, points off it to either side with their distance to
/// it, and one-sided, the skin of other regions near by.
std::vector<DistanceSample> part_samples(const std::vector<PartSkin>& skins, std::size_t r, double stature_m);

}  // namespace bodice::fitting
