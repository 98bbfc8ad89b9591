#pragma once

#include <array>

#include <bodice/body/proportions.hpp>

namespace bodice::inline v0_1::body {

/// One measure of a profile: its name in files, the member of Proportions, and the values that a human body
/// allows.
struct Measure {
  const char* name;
  double Proportions::*ratio;
  double least, most;
};

/// Every member of Proportions. The bounds are wide of any survey of adults or children. They catch
/// centimeters in place of ratios and swapped columns, not unusual bodies.
inline constexpr std::array<Measure, 15> kMeasures = {{
    {"upper_arm", &Proportions::upper_arm, 0.10, 0.30},
    {"forearm", &Proportions::forearm, 0.08, 0.25},
    {"hand", &Proportions::hand, 0.06, 0.18},
    {"fingertip_to_elbow", &Proportions::fingertip_to_elbow, 0.17, 0.36},
    {"fingertip_to_armpit", &Proportions::fingertip_to_armpit, 0.26, 0.52},
    {"crotch_height", &Proportions::crotch_height, 0.30, 0.60},
    {"knee_height", &Proportions::knee_height, 0.18, 0.36},
    {"lower_leg", &Proportions::lower_leg, 0.14, 0.32},
    {"neck_height", &Proportions::neck_height, 0.75, 0.93},
    {"acromion_height", &Proportions::acromion_height, 0.70, 0.90},
    {"axilla_height", &Proportions::axilla_height, 0.60, 0.86},
    {"chest_height", &Proportions::chest_height, 0.58, 0.84},
    {"waist_height", &Proportions::waist_height, 0.45, 0.74},
    {"head_length", &Proportions::head_length, 0.08, 0.28},
    {"foot_length", &Proportions::foot_length, 0.10, 0.21},
}};

/// The surveys that bodice ships.
const std::array<ProportionProfile, 2>& built_in_profiles();

}  // namespace bodice::body
