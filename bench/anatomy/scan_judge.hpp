// Is what was read from a scan the person that it was made of?
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/synth/scan.hpp>

namespace bench {

enum Outcome { kRight, kDoubted, kWarned, kRefused, kSilent, kAbsurd, kOutcomes };
inline constexpr std::array<const char*, kOutcomes> kOutcomeNames = {"right",   "doubts", "wrong, warned",
                                                                     "refused", "silent", "absurd"};

/// What came of one scan.
struct Judged {
  Outcome outcome = kRefused;
  double stature = 0.0, landmark = 0.0;  ///< errors beyond those on the clean body, of the stature
  std::string worst;                     ///< the landmark that is farthest off
  double foreign = 0.0;                  ///< the share of the skin that lies away from the body
  double missing = 0.0;                  ///< the share of the body that lies away from the skin
  double seen_m = 0.0;                   ///< mean distance of the skin to the clean body, where they meet
  std::optional<double> proxy_m;         ///< mean distance of a relief proxy's surface to the clean body
  std::string text;                      ///< the refusal, or the codes of the warnings
  bodice::geometry::TriMesh skin;        ///< in the truth's coordinates
  std::optional<bodice::anatomy::Anatomy> anatomy;
};

/// Reads and analyzes the file of a scan as `bodice fit` does. `with_proxy`: fits it as well, with the
/// defaults.
Judged judge(const bodice::synth::Scan& scan, const std::filesystem::path& file, bool with_proxy);

}  // namespace bench
