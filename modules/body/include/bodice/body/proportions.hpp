// Ratios of body lengths to stature: survey profiles by name, or one from a JSON file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <bodice/engine/result.hpp>

namespace bodice::inline v0_1::body {

/// The sex that a survey's means are for.
enum class Sex { kFemale, kMale };

/// Lengths and heights of a body as fractions of its stature.
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

/// A survey's mean proportions of women and of men.
struct ProportionProfile {
  std::string name;  ///< "gb10000-88", "ansur2" or the custom file's
  Proportions female;
  Proportions male;
  /// The proportions of one sex.
  const Proportions& of(Sex sex) const { return sex == Sex::kFemale ? female : male; }
  /// The mean of both sexes, for a body of unknown sex.
  Proportions either() const;
};

/// A built-in profile by name; kNotFound lists the names that exist.
engine::Result<ProportionProfile> find_profile(std::string_view name);
/// The names of the built-in profiles.
std::vector<std::string> profile_names();
/// Reads a custom profile. Fails with kNotFound, kUnreadable or kInvalidArgument; a missing or implausible
/// ratio is named.
engine::Result<ProportionProfile> load_profile(const std::filesystem::path& file);

}  // namespace bodice::body
