#include <algorithm>
#include <cmath>
#include <string>

#include <bodice/rig/clip.hpp>

#include "key_values.hpp"
#include "skeleton_errors.hpp"
#include "tolerances.hpp"

namespace bodice::inline v0_1::rig {

namespace {

bool is_finite(const Vec3& value) {
  return value.allFinite();
}
bool is_finite(const Eigen::Quaterniond& value) {
  return value.coeffs().allFinite();
}

/// The part of a sentence that follows "joint 'x' has"; empty for keys that can be played.
template <class T>
std::string flaw_of(const Keys<T>& keys, const char* kind) {
  const std::size_t per_key = keys.interpolation == Interpolation::kCubic ? 3 : 1;
  const std::string name(kind);
  if (keys.value.size() != per_key * keys.time_s.size()) return name + " keys without a value each";
  for (std::size_t k = 0; k < keys.time_s.size(); ++k)
    if (!std::isfinite(keys.time_s[k]) || (k > 0 && keys.time_s[k] < keys.time_s[k - 1]))
      return name + " keys with times that are not finite or that decrease";
  if (!std::all_of(keys.value.begin(), keys.value.end(), [](const T& v) { return is_finite(v); }))
    return "a " + name + " key that is not finite";
  return "";
}

template <class T, class Flawed>
bool any_key(const Keys<T>& keys, Flawed&& flawed) {
  for (std::size_t k = 0; k < keys.time_s.size(); ++k)
    if (flawed(key_value(keys, k))) return true;
  return false;
}

std::string flaw_of(const Track& track) {
  for (std::string flaw : {flaw_of(track.translation, "translation"), flaw_of(track.rotation, "rotation"),
                           flaw_of(track.scale, "scale")})
    if (!flaw.empty()) return flaw;
  if (any_key(track.rotation,
              [](const Eigen::Quaterniond& q) { return std::abs(q.norm() - 1.0) > kUnitRotation; }))
    return "a rotation key that is not a unit quaternion";
  if (any_key(track.scale, [](const Vec3& s) { return (s.array() == 0.0).any(); }))
    return "a scale key of zero";
  return "";
}

std::string printable(std::string name) {
  name.resize(std::min<std::size_t>(name.size(), 60));
  for (char& c : name)
    if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';
  return name;
}

}  // namespace

engine::Result<void> validate(const Clip& clip, const Skeleton& skeleton) {
  const std::string label = "Clip '" + printable(clip.name) + "'";
  if (!std::isfinite(clip.duration_s) || clip.duration_s < 0.0)
    return unusable(label + " has a duration that is negative or not finite.", "Export the clip again.");
  for (std::size_t i = 0; i < clip.tracks.size(); ++i) {
    const Track& track = clip.tracks[i];
    if (track.joint >= skeleton.joints.size())
      return unusable(label + " moves joint " + std::to_string(track.joint) + ", but the skeleton has " +
                          std::to_string(skeleton.joints.size()) + " joints.",
                      "Play it on the skeleton it was made for, or retarget it.");
    if (i > 0 && track.joint <= clip.tracks[i - 1].joint)
      return unusable(
          label + " has its tracks out of order or twice at joint " + std::to_string(track.joint) + ".",
          "Sort the tracks by joint and keep one a joint.");
    if (const std::string flaw = flaw_of(track); !flaw.empty())
      return unusable(label + ": " + joint_label(skeleton, track.joint) + " has " + flaw + ".",
                      "Mend or delete that key and export the clip again.");
  }
  return {};
}

}  // namespace bodice::rig
