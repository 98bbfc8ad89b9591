#include "whole/rig.hpp"

#include <cmath>
#include <vector>

#include "arrays/matrices.hpp"
#include "base/handles.hpp"
#include "base/structures.hpp"

namespace bodice::inline v0_1::capi {
namespace {

Outcome check(const bodice_rig& rig, const bodice_pose& bind, std::size_t vertices) {
  if (bind.count == 0 || bind.count > rig::kMaxJoints)
    return invalid("bodice_rig.bind has " + std::to_string(bind.count) + " matrices.",
                   "Give one a joint, 1 to 65535.");
  BODICE_CHECK(check_matrices(bind, bind.count, "joints"));
  if (rig.vertices != vertices)
    return invalid("The rig has weights of " + std::to_string(rig.vertices) + " vertices, the mesh has " +
                       std::to_string(vertices) + ".",
                   "Pass the weights of this mesh.");
  if (!rig.joint || !rig.weight || rig.joints_per_vertex < 1 || rig.joints_per_vertex > 64)
    return invalid("The rig has no weights.", "Set joint, weight, and joints_per_vertex from 1 to 64.");
  return {};
}

Outcome read_skeleton(const bodice_rig& given, const bodice_pose& bind, rig::Skeleton& out) {
  std::vector<proxy::JointMatrix> matrices(bind.count);
  read_matrices(bind, matrices);
  for (std::uint32_t j = 0; j < bind.count; ++j) {
    rig::Joint joint;
    joint.name = given.names && given.names[j] ? given.names[j] : "joint_" + std::to_string(j);
    joint.parent = given.parents ? given.parents[j] : rig::kNoParent;
    joint.bind = matrices[j];
    if (joint.parent < rig::kNoParent || joint.parent >= static_cast<std::int32_t>(j))
      return invalid("Joint " + std::to_string(j) + " has the parent " + std::to_string(joint.parent) + ".",
                     "Sort joints so that parents come before children; -1 is a root.");
    if (!matrices[j].allFinite() || !(std::abs(rig::linear_of(matrices[j]).determinant()) > 1e-12))
      return invalid("The bind matrix of joint " + std::to_string(j) + " is not finite or not invertible.",
                     "Give the matrix that takes joint space to mesh space.");
    rig::Affine local = joint.bind;
    if (joint.parent >= 0) {
      const rig::Affine& parent = out.joints[static_cast<std::size_t>(joint.parent)].bind;
      const rig::Mat3 inverse = rig::linear_of(parent).inverse();
      local =
          rig::affine(inverse * rig::linear_of(joint.bind), inverse * (joint.bind.col(3) - parent.col(3)));
    }
    joint.local = rig::to_local_transform(local);
    out.joints.push_back(std::move(joint));
  }
  return {};
}

Outcome read_weights(const bodice_rig& given, std::size_t joints, rig::SkinWeights& out) {
  out.first.push_back(0);
  for (std::size_t v = 0; v < given.vertices; ++v) {
    for (std::size_t i = v * given.joints_per_vertex; i < (v + 1) * given.joints_per_vertex; ++i) {
      const float weight = given.weight[i];
      if (weight == 0.0f) continue;
      if (!(weight > 0.0f) || !std::isfinite(weight) || given.joint[i] >= joints)
        return invalid("Vertex " + std::to_string(v) + " has the weight " + std::to_string(weight) +
                           " of joint " + std::to_string(given.joint[i]) + ".",
                       "Weights are zero or more; there are " + std::to_string(joints) + " joints.");
      out.joint.push_back(given.joint[i]);
      out.weight.push_back(weight);
    }
    out.first.push_back(static_cast<std::uint32_t>(out.joint.size()));
  }
  return {};
}

}  // namespace

Outcome read_rig(const bodice_rig* given, std::size_t vertices, rig::Rig& out) {
  bodice_rig rig;
  bodice_pose bind;
  BODICE_CHECK(read(given, rig));
  BODICE_CHECK(read(rig.bind, bind));
  BODICE_CHECK(check(rig, bind, vertices));
  BODICE_CHECK(read_skeleton(rig, bind, out.skeleton));
  return read_weights(rig, bind.count, out.weights);
}

}  // namespace bodice::capi
