// Corrections: how far a landmark lies from a first estimate, by what was measured on the body.
#pragma once

#include <span>
#include <vector>

#include <bodice/geometry/types.hpp>

namespace bodice::anatomy {

/// A direction in which a landmark may move, and the measures that its distance follows.
struct CorrectionAxis {
  geometry::Vec3 direction = geometry::Vec3::Zero();
  std::vector<double> measures;
};

/// What a correction is computed from; without axes the first estimate stays. Lengths among the measures are
/// fractions of the body size.
struct CorrectionInput {
  geometry::Vec3 first = geometry::Vec3::Zero();
  double size_m = 0.0;
  std::vector<CorrectionAxis> axes;
};

/// The corrected position, and the length of the correction before it was limited, as a fraction of the body
/// size.
struct Corrected {
  geometry::Vec3 position = geometry::Vec3::Zero();
  double wanted = 0.0;
};

/// Moves the first estimate along each axis by weight[0] + weight[1] measure[0] + ..., a fraction of the body
/// size that is limited to +-most. `weights`: one list an axis, one longer than its measures.
Corrected corrected(const CorrectionInput& input, std::initializer_list<std::span<const double>> weights,
                    double most);

/// Limits each measure to what the calibration bodies measure; beyond it nothing is known.
void clamp_measures(std::span<double> measures, std::span<const double> least, std::span<const double> most);

}  // namespace bodice::anatomy
