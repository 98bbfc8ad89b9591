// Based on: Ilya Baran, Jovan Popović. Automatic rigging and animation of 3D characters. 2007. - section 4
// Differs: a vertex's nearest bone is sought among those of its part, and not by visibility.
#include "weights/heat.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/SparseCholesky>

#include <bodice/engine/parallel.hpp>

#include "weights/laplacian.hpp"

namespace bodice::inline v0_1::rigging {
namespace {

using body::JointId;

/// Heat's constant c: one is the publication's; larger values make a bend sharper. Chosen once, on the posed
/// skins of made and of rigged bodies, on which errors change by a tenth between half and twice these values.
constexpr double kTrunkHeat = 3.0, kLimbHeat = 6.0;
/// Bones count as no nearer and no farther than these fractions of the stature: heat would not spread at all,
/// or far around a wide trunk.
constexpr double kLeastDistance = 0.008, kMostDistance = 0.04;
constexpr double kLeastWeight = 0.002;

using Heat = std::array<Eigen::VectorXd, body::kJointCount>;

bool is_limb(JointId id) {
  return id >= JointId::kUpperArmL;
}

int side_of(JointId id) {
  return static_cast<int>(id) % 2;  // limbs begin at an even number, left first
}

double heat_of(JointId bone) {
  return is_limb(bone) ? kLimbHeat : kTrunkHeat;
}

struct JointShare {
  int joint;
  double weight;
};

/// The heaviest joints of a vertex, in order of joints, with sum 1.
void append_vertex(const Heat& heat, JointId own, Eigen::Index v, rig::SkinWeights& weights) {
  std::array<JointShare, body::kJointCount> entries;
  int count = 0;
  for (int j = 0; j < body::kJointCount; ++j) {
    const auto id = static_cast<JointId>(j);
    if (is_limb(own) && is_limb(id) && side_of(own) != side_of(id)) continue;
    if (heat[j].size() > 0 && heat[j][v] > kLeastWeight) entries[count++] = {j, heat[j][v]};
  }
  if (count == 0) entries[count++] = {static_cast<int>(own), 1.0};
  std::sort(entries.begin(), entries.begin() + count, [](const JointShare& a, const JointShare& b) {
    return a.weight > b.weight || (a.weight == b.weight && a.joint < b.joint);
  });
  count = std::min(count, kInfluences);
  double sum = 0.0;
  for (int k = 0; k < count; ++k) sum += entries[k].weight;
  std::sort(entries.begin(), entries.begin() + count,
            [](const JointShare& a, const JointShare& b) { return a.joint < b.joint; });
  for (int k = 0; k < count; ++k) {
    weights.joint.push_back(static_cast<std::uint16_t>(entries[k].joint));
    weights.weight.push_back(static_cast<float>(entries[k].weight / sum));
  }
  weights.first.push_back(static_cast<std::uint32_t>(weights.joint.size()));
}

engine::Error singular() {
  return {engine::ErrorCode::kUnusableGeometry,
          "The skin's weights cannot be solved for: its triangles have no size.",
          "Remove triangles without area, or give a finer mesh."};
}

}  // namespace

engine::Result<rig::SkinWeights> heat_weights(const engine::Context& context, const SkinCurves& skin,
                                              const NearestBone& nearest) {
  const auto n = static_cast<Eigen::Index>(skin.skin().positions.size());
  Laplacian system = laplacian(skin.skin());
  Eigen::VectorXd source(n);  // the diagonal of A H
  const double stature_m = skin.anatomy().stature_m;
  for (Eigen::Index v = 0; v < n; ++v) {
    const double d = std::clamp(nearest.distance_m[v], kLeastDistance * stature_m, kMostDistance * stature_m);
    source[v] = std::max(system.area[v], 1e-9) * heat_of(nearest.bone[v]) / (d * d);
    system.stiffness.coeffRef(v, v) += source[v];
  }
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver(system.stiffness);
  if (solver.info() != Eigen::Success) return singular();
  Heat heat;
  engine::parallel_for(context, body::kJointCount, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
      bool any = false;
      for (Eigen::Index v = 0; v < n; ++v)
        if (nearest.bone[v] == static_cast<JointId>(j)) {
          right[v] = source[v];
          any = true;
        }
      if (any) heat[j] = solver.solve(right);
    }
  });
  rig::SkinWeights weights;
  weights.first.push_back(0);
  for (Eigen::Index v = 0; v < n; ++v) append_vertex(heat, nearest.bone[v], v, weights);
  return weights;
}

}  // namespace bodice::rigging
