// How errors of this layer name a joint.
#pragma once

#include <string>
#include <utility>

#include <bodice/engine/result.hpp>
#include <bodice/rig/skeleton.hpp>

namespace bodice::inline v0_1::rig {

inline engine::Error unusable(std::string message, std::string remedy) {
  return {engine::ErrorCode::kUnusableGeometry, std::move(message), std::move(remedy)};
}

/// "Joint 3 ('thigh_l')", with unprintable bytes of the name replaced.
inline std::string joint_label(const Skeleton& skeleton, std::size_t joint) {
  std::string name = joint < skeleton.joints.size() ? skeleton.joints[joint].name.substr(0, 60) : "";
  for (char& c : name)
    if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';
  return "Joint " + std::to_string(joint) + (name.empty() ? "" : " ('" + name + "')");
}

}  // namespace bodice::rig
