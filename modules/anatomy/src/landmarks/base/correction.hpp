// Corrections: how far a landmark lies from a first estimate, by what was measured on the body.
#pragma once

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "landmarks/base/landmarks.hpp"

namespace bodice::inline v0_1::anatomy {

/// Coefficients with their name in the landmark's file of modules/anatomy/data.
struct Coefficients {
  const char* member = "";
  std::span<const double> values;
};

/// A direction in which a landmark may move, and the measures that its distance follows.
struct CorrectionAxis {
  geometry::Vec3 direction = geometry::Vec3::Zero();
  std::vector<double> measures;
  /// The distance is values[0] + values[1] measures[0] + ..., a fraction of the body size.
  Coefficients weights;
  /// Whether a mirror changes the sign of all measures and of the distance: values[0] is then zero.
  bool odd = false;
};

/// How one landmark is corrected; without axes the first estimate stays. Lengths among the measures are
/// fractions of the body size.
struct Correction {
  LandmarkId of = LandmarkId::kCrown;
  geometry::Vec3 first = geometry::Vec3::Zero();
  std::vector<CorrectionAxis> axes;
  double most = 0.0;  ///< the farthest along one axis, as a fraction of the body size
};

/// The corrected position, and the length of the correction before it was limited, as a fraction of the body
/// size.
struct Corrected {
  geometry::Vec3 position = geometry::Vec3::Zero();
  double wanted = 0.0;
};

/// The least and the most that the calibration bodies measure; beyond it nothing is known.
struct MeasureLimits {
  Coefficients least, most;
};

/// Coefficients by landmark and member, in place of those of the files.
using TrialCoefficients = std::map<std::pair<LandmarkId, std::string>, std::vector<double>>;

/// What the corrections of one body were computed from: bench/calibrate fits their coefficients to it.
struct CorrectionRecords {
  struct Measured {
    LandmarkId of;
    MeasureLimits limits;
    std::vector<double> measures;  ///< as measured, without limits
  };
  std::vector<Correction> corrections;
  std::vector<Measured> measured;
  /// What has been made again so far, so that later corrections start from it; null: nothing.
  const TrialCoefficients* trial = nullptr;
};

/// The coefficients of a landmark that count: those on trial where there are any.
std::span<const double> values_of(const LandmarkInput& input, LandmarkId of,
                                  const Coefficients& coefficients);

/// Records the correction where corrections are recorded.
void record(const LandmarkInput& input, const Correction& correction);

/// Records the correction, and moves the first estimate along each axis.
Corrected corrected(const LandmarkInput& input, const Correction& correction);

/// Limits each measure. Where corrections are recorded the measures stay as they are, because the limits are
/// then made from them.
void limit_measures(const LandmarkInput& input, LandmarkId of, const MeasureLimits& limits,
                    std::span<double> measures);

}  // namespace bodice::anatomy
