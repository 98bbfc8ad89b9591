#include "pose/refusal.hpp"

namespace bodice::inline v0_1::binding {

engine::Result<void> check_bound(const proxy::BodyProxy& proxy) {
  if (proxy.binding()) return {};
  return engine::Error{engine::ErrorCode::kInvalidArgument, "Pose: the proxy is not bound to joints.",
                       "Bind it to a rig, or fit it to a body file that has one."};
}

engine::Result<void> check_joints(const proxy::BodyProxy& bound, std::size_t matrices) {
  const std::size_t joints = bound.binding()->bind.size();
  if (matrices == joints) return {};
  return engine::Error{
      engine::ErrorCode::kInvalidArgument,
      "Pose: there are " + std::to_string(matrices) + " matrices for " + std::to_string(joints) + " joints.",
      "Give one matrix a joint, in the order of the binding."};
}

engine::Error refused_joint(const std::string& joint, std::string_view reason) {
  return {engine::ErrorCode::kInvalidArgument,
          "Pose: the matrix of joint '" + joint + "' " + std::string(reason) + ".",
          "Give each joint a rotation, a translation and one scale."};
}

}  // namespace bodice::binding
