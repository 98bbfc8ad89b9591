// The 15 parts of a body, those of things that are no body, and their names.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include <bodice/engine/version.hpp>

namespace bodice::inline v0_1::body {

/// A part of the body. Left and right are the body's own. The letters after kTorso are upper, middle or
/// lower, then left or right. A forearm includes the hand, a calf the foot, the head the neck. From kThing on
/// there are kThingPartCount parts of a thing, by falling area.
enum class Part : std::uint8_t {
  kHead,
  kTorsoUL,
  kTorsoUR,
  kTorsoML,
  kTorsoMR,
  kTorsoLL,
  kTorsoLR,
  kUpperArmL,
  kUpperArmR,
  kForearmL,
  kForearmR,
  kThighL,
  kThighR,
  kCalfL,
  kCalfR,
  kThing,
};

inline constexpr int kPartCount = 15;                               ///< how many parts a body has
inline constexpr int kThingPartCount = 16;                          ///< how many a thing has at most
inline constexpr int kAllPartCount = kPartCount + kThingPartCount;  ///< how many values there are

inline constexpr std::array<std::string_view, kAllPartCount> kPartNames = {
    "head",        "torso_ul",  "torso_ur",  "torso_ml", "torso_mr", "torso_ll", "torso_lr", "upper_arm_l",
    "upper_arm_r", "forearm_l", "forearm_r", "thigh_l",  "thigh_r",  "calf_l",   "calf_r",   "part_1",
    "part_2",      "part_3",    "part_4",    "part_5",   "part_6",   "part_7",   "part_8",   "part_9",
    "part_10",     "part_11",   "part_12",   "part_13",  "part_14",  "part_15",  "part_16"};

/// The name of a part in files and messages, such as "forearm_l".
constexpr std::string_view name(Part part) {
  return kPartNames[static_cast<std::size_t>(part)];
}

/// The part of a name, of a body or of a thing; nothing if no part has it.
constexpr std::optional<Part> part_from_name(std::string_view text) {
  for (std::size_t i = 0; i < kAllPartCount; ++i)
    if (kPartNames[i] == text) return static_cast<Part>(i);
  return std::nullopt;
}

/// Part number `index` of a thing, from 0.
constexpr Part thing_part(int index) {
  return static_cast<Part>(static_cast<int>(Part::kThing) + index);
}

/// Whether a part is one of a thing, and not of a body.
constexpr bool is_of_thing(Part part) {
  return part >= Part::kThing;
}

/// Whether a part is one of the six of the torso.
constexpr bool is_torso(Part part) {
  return part >= Part::kTorsoUL && part <= Part::kTorsoLR;
}

/// The same part on the other side; the head is its own mirror, as is each part of a thing.
constexpr Part mirrored(Part part) {
  if (part == Part::kHead || is_of_thing(part)) return part;
  const int i = static_cast<int>(part) - 1;
  return static_cast<Part>((i ^ 1) + 1);
}

}  // namespace bodice::body
