// Ratios of body measures to stature, as data: named survey profiles, or one from a JSON file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <bodice/engine/result.hpp>

namespace bodice::body {

enum class Sex { kFemale, kMale };

/// All lengths and heights as ratios to stature.
struct Proportions {
  double upper_arm = 0.0;  ///< acromion to radiale
  double forearm = 0.0;    ///< radiale to stylion
  double hand = 0.0;
  double fingertip_to_elbow = 0.0;
  double fingertip_to_armpit = 0.0;
  double crotch_height = 0.0;
  double knee_height = 0.0;
  double lower_leg = 0.0;
  double neck_height = 0.0;  ///< C7
  double acromion_height = 0.0;
  double axilla_height = 0.0;
  double chest_height = 0.0;
  double waist_height = 0.0;
  double head_length = 0.0;  ///< vertex to chin
  double foot_length = 0.0;
};

struct ProportionProfile {
  std::string name;  ///< "gb10000-88", "ansur2" or the custom file's
  Proportions female;
  Proportions male;
  const Proportions& of(Sex sex) const { return sex == Sex::kFemale ? female : male; }
  /// The mean of both, for a body whose sex is not given.
  Proportions either() const;
};

/// A built-in profile by name; kNotFound lists the names that exist.
engine::Result<ProportionProfile> find_profile(std::string_view name);
std::vector<std::string> profile_names();
/// Reads a custom profile; every missing or implausible ratio is an error that names it.
engine::Result<ProportionProfile> load_profile(const std::filesystem::path& file);

}  // namespace bodice::body
