// The fits: each makes one file of coefficients from made bodies.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "bodies.hpp"
#include "landmarks/base/landmark_kind.hpp"

namespace calibrate {

using Samples = std::vector<const Sample*>;
using nlohmann::ordered_json;

/// Measures of a build.
inline constexpr int kBuildCount = static_cast<int>(std::tuple_size_v<bodice::anatomy::Build>);

/// Numbers with the digits that single precision holds.
ordered_json rounded(const Eigen::VectorXd& values);

/// Mean and covariance of the coordinates of the true landmark, after what the build explains of them.
ordered_json fit_signature(const bodice::anatomy::LandmarkKind& kind, const Samples& samples);

/// Least squares of the height above the true level over the trunk's skin near it. `samples`: standing
/// bodies.
ordered_json fit_trunk_level(const bodice::anatomy::LandmarkKind& kind, const Samples& samples);

/// Least squares of the distance beyond the joint, along the limb, over the skin near it.
ordered_json fit_limb_level(const bodice::anatomy::LandmarkKind& kind, const Samples& samples);

}  // namespace calibrate
