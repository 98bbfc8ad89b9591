// The 15 parts of a body and their names.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace bodice::body {

/// A part of the body. Left and right are the body's own. The letters after kTorso are upper, middle or
/// lower, then left or right. A forearm includes the hand, a calf the foot, the head the neck.
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
};

inline constexpr int kPartCount = 15;

inline constexpr std::array<std::string_view, kPartCount> kPartNames = {
    "head",        "torso_ul",  "torso_ur",  "torso_ml", "torso_mr", "torso_ll", "torso_lr", "upper_arm_l",
    "upper_arm_r", "forearm_l", "forearm_r", "thigh_l",  "thigh_r",  "calf_l",   "calf_r"};

constexpr std::string_view name(Part part) {
  return kPartNames[static_cast<int>(part)];
}

constexpr std::optional<Part> part_from_name(std::string_view text) {
  for (int i = 0; i < kPartCount; ++i)
    if (kPartNames[i] == text) return static_cast<Part>(i);
  return std::nullopt;
}

constexpr bool is_torso(Part part) {
  return part >= Part::kTorsoUL && part <= Part::kTorsoLR;
}

/// The same part on the other side; the head is its own mirror.
constexpr Part mirrored(Part part) {
  if (part == Part::kHead) return part;
  const int i = static_cast<int>(part) - 1;
  return static_cast<Part>((i ^ 1) + 1);
}

}  // namespace bodice::body
