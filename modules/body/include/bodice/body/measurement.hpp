// The measurements of a body that garments are made from. Names and number are those of GarmentCode's body
// files; what each means here is defined in modules/anatomy/README.md.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

#include <bodice/engine/version.hpp>

namespace bodice::inline v0_1::body {

/// Lengths, girths and angles of a body by name.
enum class MeasurementId : std::uint8_t {
  kHeight,
  kHeadLength,
  kNeckWidth,
  kShoulderWidth,
  kShoulderInclination,
  kArmLength,
  kArmPoseAngle,
  kArmscyeDepth,
  kWrist,
  kBust,
  kBustLine,
  kVerticalBustLine,
  kBustPoints,
  kBackWidth,
  kUnderbust,
  kWaist,
  kWaistLine,
  kWaistOverBustLine,
  kWaistBackWidth,
  kHips,
  kHipsLine,
  kHipBackWidth,
  kHipInclination,
  kBumPoints,
  kCrotchHipDifference,
  kLegCircumference,
};

inline constexpr int kMeasurementCount = 26;

inline constexpr std::array<std::string_view, kMeasurementCount> kMeasurementNames = {"height",
                                                                                      "head_l",
                                                                                      "neck_w",
                                                                                      "shoulder_w",
                                                                                      "shoulder_incl",
                                                                                      "arm_length",
                                                                                      "arm_pose_angle",
                                                                                      "armscye_depth",
                                                                                      "wrist",
                                                                                      "bust",
                                                                                      "bust_line",
                                                                                      "vert_bust_line",
                                                                                      "bust_points",
                                                                                      "back_width",
                                                                                      "underbust",
                                                                                      "waist",
                                                                                      "waist_line",
                                                                                      "waist_over_bust_line",
                                                                                      "waist_back_width",
                                                                                      "hips",
                                                                                      "hips_line",
                                                                                      "hip_back_width",
                                                                                      "hip_inclination",
                                                                                      "bum_points",
                                                                                      "crotch_hip_diff",
                                                                                      "leg_circ"};

/// The name of a measurement in files and messages, such as "waist_line".
constexpr std::string_view name(MeasurementId id) {
  return kMeasurementNames[static_cast<int>(id)];
}

/// Whether a measurement is an angle, which is in radians; all others are in meters.
constexpr bool is_angle(MeasurementId id) {
  return id == MeasurementId::kShoulderInclination || id == MeasurementId::kArmPoseAngle ||
         id == MeasurementId::kHipInclination;
}

/// All measurements of one body, meters and radians; NaN where one could not be taken.
struct Measurements {
  std::array<double, kMeasurementCount> value = all(std::numeric_limits<double>::quiet_NaN());

  double& operator[](MeasurementId id) { return value[static_cast<std::size_t>(id)]; }
  double operator[](MeasurementId id) const { return value[static_cast<std::size_t>(id)]; }

 private:
  static constexpr std::array<double, kMeasurementCount> all(double x) {
    std::array<double, kMeasurementCount> values{};
    values.fill(x);
    return values;
  }
};

}  // namespace bodice::body
