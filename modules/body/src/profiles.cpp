// Based on: GB 10000-88. Human dimensions of Chinese adults. 1988. - median men and women
// Based on: Claire C. Gordon et al. 2012 Anthropometric Survey of U.S. Army Personnel (ANSUR II). 2014. -
// means over 4082 men and 1986 women of the public tables, each measure divided by the person's stature
#include "profiles.hpp"

namespace bodice::inline v0_1::body {
namespace {

// The public tables of ANSUR II have no vertex-to-chin length; it is that of GB 10000-88.
constexpr Proportions kAnsurMale = {
    .upper_arm = 0.1907,
    .forearm = 0.1521,
    .hand = 0.1100,
    .fingertip_to_elbow = 0.262,
    .fingertip_to_armpit = 0.384,
    .crotch_height = 0.481,
    .knee_height = 0.266,
    .lower_leg = 0.225,
    .neck_height = 0.864,
    .acromion_height = 0.821,
    .axilla_height = 0.757,
    .chest_height = 0.735,
    .waist_height = 0.602,
    .head_length = 0.133,
    .foot_length = 0.154,
};
constexpr Proportions kAnsurFemale = {
    .upper_arm = 0.1909,
    .forearm = 0.1478,
    .hand = 0.1109,
    .fingertip_to_elbow = 0.258,
    .fingertip_to_armpit = 0.384,
    .crotch_height = 0.480,
    .knee_height = 0.269,
    .lower_leg = 0.230,
    .neck_height = 0.857,
    .acromion_height = 0.820,
    .axilla_height = 0.761,
    .chest_height = 0.719,
    .waist_height = 0.602,
    .head_length = 0.138,
    .foot_length = 0.151,
};

// GB 10000-88 does not measure fingertip to armpit, nor the heights of axilla, chest and waist: those four
// are ANSUR II's. Its height of C7 is derived from other measures. Its own thigh length is left out, because
// it starts at the iliac spine and not at the crotch.
constexpr Proportions kGbMale = {
    .upper_arm = 0.1865,
    .forearm = 0.1412,
    .hand = 0.1091,
    .fingertip_to_elbow = 0.250,
    .fingertip_to_armpit = kAnsurMale.fingertip_to_armpit,
    .crotch_height = 0.471,
    .knee_height = 0.265,
    .lower_leg = 0.220,
    .neck_height = 0.850,
    .acromion_height = 0.815,
    .axilla_height = kAnsurMale.axilla_height,
    .chest_height = kAnsurMale.chest_height,
    .waist_height = kAnsurMale.waist_height,
    .head_length = 0.133,
    .foot_length = 0.147,
};
constexpr Proportions kGbFemale = {
    .upper_arm = 0.1809,
    .forearm = 0.1357,
    .hand = 0.1089,
    .fingertip_to_elbow = 0.245,
    .fingertip_to_armpit = kAnsurFemale.fingertip_to_armpit,
    .crotch_height = 0.466,
    .knee_height = 0.261,
    .lower_leg = 0.219,
    .neck_height = 0.848,
    .acromion_height = 0.810,
    .axilla_height = kAnsurFemale.axilla_height,
    .chest_height = kAnsurFemale.chest_height,
    .waist_height = kAnsurFemale.waist_height,
    .head_length = 0.138,
    .foot_length = 0.146,
};

}  // namespace

const std::array<ProportionProfile, 2>& built_in_profiles() {
  static const std::array<ProportionProfile, 2> profiles = {{
      {"gb10000-88", kGbFemale, kGbMale},
      {"ansur2", kAnsurFemale, kAnsurMale},
  }};
  return profiles;
}

}  // namespace bodice::body
