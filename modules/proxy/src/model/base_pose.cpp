#include <bodice/proxy/base_pose.hpp>

#include <algorithm>
#include <cmath>

#include "binding/check_binding.hpp"

namespace bodice::inline v0_1::proxy {
namespace {

engine::Error unfit(std::string what) {
  return {engine::ErrorCode::kInvalidArgument, "Base pose: " + std::move(what) + ".",
          "Give one that was made for this proxy."};
}

bool is_same_layout(const ReliefTable& a, const ReliefTable& b) {
  return a.nodes_per_side == b.nodes_per_side && a.first_texel == b.first_texel;
}

bool is_finite(const ReliefTable& table) {
  const auto bounded = [](float value) { return std::abs(value) <= 1e15f; };
  return bounded(table.h_scale_m) && bounded(table.h_offset_m) && bounded(table.a_scale) &&
         bounded(table.a_offset);
}

bool is_finite(const JointMatrix& joint) {
  return joint.cwiseAbs().maxCoeff() <= kLargestEntry;  // false for what is not a number
}

}  // namespace

std::size_t BasePose::bytes() const {
  return joints.size() * sizeof(JointMatrix) + relief.size() * sizeof(ReliefTable) +
         texels.size() * sizeof(ReliefTexel);
}

engine::Result<void> check_base(const BodyProxy& bound, const BasePose& base) {
  if (!bound.binding()) return unfit("the proxy is not bound to joints");
  if (base.name.size() > kLongestName) return unfit("its name is longer than 65535 bytes");
  const std::string which = "'" + base.name + "' ";
  if (base.joints.size() != bound.binding()->joint_names.size())
    return unfit(which + "has " + std::to_string(base.joints.size()) + " matrices for " +
                 std::to_string(bound.binding()->joint_names.size()) + " joints");
  for (std::size_t j = 0; j < base.joints.size(); ++j)
    if (!base.joints[j].allFinite() || !is_finite(base.joints[j]))
      return unfit(which + "has a matrix of joint '" + bound.binding()->joint_names[j] +
                   "' that is not finite");
  if (base.texels.size() != bound.texels().size() ||
      !std::ranges::equal(base.relief, bound.relief(), is_same_layout))
    return unfit(which + "has tables of other sizes than the proxy");
  if (!std::ranges::all_of(base.relief, [](const ReliefTable& table) { return is_finite(table); }))
    return unfit(which + "has a relief scale that is not finite");
  return {};
}

}  // namespace bodice::proxy
