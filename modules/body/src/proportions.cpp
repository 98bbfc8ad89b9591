#include <bodice/body/proportions.hpp>

#include "profiles.hpp"

namespace bodice::inline v0_1::body {

Proportions ProportionProfile::either() const {
  Proportions mean;
  for (const Measure& m : kMeasures) mean.*m.ratio = 0.5 * (female.*m.ratio + male.*m.ratio);
  return mean;
}

std::vector<std::string> profile_names() {
  std::vector<std::string> names;
  for (const ProportionProfile& profile : built_in_profiles()) names.push_back(profile.name);
  return names;
}

engine::Result<ProportionProfile> find_profile(std::string_view name) {
  std::string known;
  for (const ProportionProfile& profile : built_in_profiles()) {
    if (profile.name == name) return profile;
    known += (known.empty() ? "" : ", ") + profile.name;
  }
  return engine::Error{engine::ErrorCode::kNotFound,
                       "There is no proportion profile named '" + std::string(name) + "'.",
                       "Use one of " + known + ", or a custom profile from a JSON file."};
}

}  // namespace bodice::body
