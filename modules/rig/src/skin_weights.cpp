#include <algorithm>
#include <cmath>
#include <string>

#include <bodice/engine/message.hpp>
#include <bodice/rig/skinning.hpp>

#include "skeleton_errors.hpp"
#include "tolerances.hpp"

namespace bodice::inline v0_1::rig {

namespace {

std::string vertex_label(std::size_t vertex) {
  return "Vertex " + std::to_string(vertex);
}

engine::Result<void> check_table(const SkinWeights& weights, std::size_t vertices) {
  const std::string remedy = "Give first[] one entry more than vertices, from 0 to the number of weights.";
  if (weights.first.size() != vertices + 1)
    return unusable("The skin has " + std::to_string(vertices) + " vertices, but its weights are for " +
                        std::to_string(weights.vertices()) + ".",
                    remedy);
  if (weights.joint.size() != weights.weight.size() || weights.first.front() != 0 ||
      weights.first.back() != weights.joint.size() ||
      !std::is_sorted(weights.first.begin(), weights.first.end()))
    return unusable("The table of skin weights is inconsistent: its counts do not add up.", remedy);
  return {};
}

engine::Result<void> check_entry(const SkinWeights& weights, std::size_t vertex, std::size_t entry,
                                 const Skeleton& skeleton) {
  if (weights.joint[entry] >= skeleton.joints.size())
    return unusable(vertex_label(vertex) + " is bound to joint " + std::to_string(weights.joint[entry]) +
                        ", but the skeleton has " + std::to_string(skeleton.joints.size()) + " joints.",
                    "Bind it to a joint that exists.");
  const float weight = weights.weight[entry];
  if (!std::isfinite(weight) || weight < 0.0f)
    return unusable(vertex_label(vertex) + " has a weight for " +
                        joint_label(skeleton, weights.joint[entry]) + " that is negative or not finite.",
                    "Normalize the skin weights and export the rig again.");
  return {};
}

/// Appends the entries of a vertex, one a joint and none of weight zero; returns the sum of their weights.
double append_merged(const SkinWeights& from, std::size_t vertex, SkinWeights& to) {
  const std::size_t begin = to.joint.size();
  double sum = 0.0;
  for (std::size_t e = from.first[vertex]; e < from.first[vertex + 1]; ++e) {
    if (from.weight[e] == 0.0f) continue;
    sum += static_cast<double>(from.weight[e]);
    const auto first = to.joint.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto same = std::find(first, to.joint.end(), from.joint[e]);
    if (same != to.joint.end()) {
      to.weight[static_cast<std::size_t>(same - to.joint.begin())] += from.weight[e];
    } else {
      to.joint.push_back(from.joint[e]);
      to.weight.push_back(from.weight[e]);
    }
  }
  for (std::size_t e = begin; e < to.weight.size(); ++e)
    to.weight[e] = static_cast<float>(static_cast<double>(to.weight[e]) / sum);
  return sum;
}

engine::Warning off_by(std::size_t count, std::size_t vertices, double worst) {
  return {"weights-normalized", "",
          engine::message("The skin weights of ", count, " of ", vertices,
                          " vertices do not add up to 1 (the farthest sum is ", worst,
                          "); they were divided by their sum."),
          "Normalize the skin weights before exporting."};
}

}  // namespace

engine::Result<std::vector<engine::Warning>> mend(SkinWeights& weights, const Skeleton& skeleton,
                                                  std::size_t vertices) {
  if (auto checked = check_table(weights, vertices); !checked) return checked.error();
  SkinWeights mended;
  mended.first.reserve(vertices + 1);
  mended.first.push_back(0);
  mended.joint.reserve(weights.joint.size());
  mended.weight.reserve(weights.weight.size());
  std::size_t off = 0;
  double worst = 1.0;
  for (std::size_t v = 0; v < vertices; ++v) {
    for (std::size_t e = weights.first[v]; e < weights.first[v + 1]; ++e)
      if (auto checked = check_entry(weights, v, e, skeleton); !checked) return checked.error();
    const double sum = append_merged(weights, v, mended);
    if (!(sum > 0.0))
      return unusable(vertex_label(v) + " of the skin has no weight for any joint.",
                      "Bind every vertex to a joint and export the rig again.");
    mended.first.push_back(static_cast<std::uint32_t>(mended.joint.size()));
    off += std::abs(sum - 1.0) > kWeightSum;
    if (std::abs(sum - 1.0) > std::abs(worst - 1.0)) worst = sum;
  }
  weights = std::move(mended);
  std::vector<engine::Warning> warnings;
  if (off > 0) warnings.push_back(off_by(off, vertices, worst));
  return warnings;
}

}  // namespace bodice::rig
