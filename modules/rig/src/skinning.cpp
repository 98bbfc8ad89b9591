#include <bodice/engine/parallel.hpp>
#include <bodice/rig/skinning.hpp>

#include "grain.hpp"

namespace bodice::inline v0_1::rig {

namespace {

/// The weighted sum in double precision. The first weight is what the others leave of 1, so that a rigid
/// motion far from the origin stays rigid although weights are floats.
Affine blend(const SkinWeights& weights, std::size_t vertex, std::span<const Affine> skinning) {
  const std::size_t begin = weights.first[vertex], end = weights.first[vertex + 1];
  const Affine& base = skinning[weights.joint[begin]];
  Affine sum = base;
  for (std::size_t e = begin + 1; e < end; ++e)
    sum += static_cast<double>(weights.weight[e]) * (skinning[weights.joint[e]] - base);
  return sum;
}

}  // namespace

void skinning_matrices(const Skeleton& skeleton, std::span<const Affine> world, std::span<Affine> skinning) {
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
    skinning[j] = compose(world[j], inverse(skeleton.joints[j].bind));
}

Affine blended_matrix(const SkinWeights& weights, std::size_t vertex, std::span<const Affine> skinning) {
  return blend(weights, vertex, skinning);
}

void skin_linear(std::span<const Vec3> rest, const SkinWeights& weights, std::span<const Affine> skinning,
                 std::span<Vec3> posed) {
  for (std::size_t v = 0; v < rest.size(); ++v) posed[v] = apply(blend(weights, v, skinning), rest[v]);
}

void skin_linear(const engine::Context& context, std::span<const Vec3> rest, const SkinWeights& weights,
                 std::span<const Affine> skinning, std::span<Vec3> posed) {
  engine::parallel_for(context, rest.size(), kSkinGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) posed[v] = apply(blend(weights, v, skinning), rest[v]);
  });
}

void skinning_rates(std::span<const Affine> before, std::span<const Affine> after, double dt_s,
                    std::span<Affine> rates) {
  for (std::size_t j = 0; j < before.size(); ++j)
    rates[j] = dt_s > 0.0 ? Affine((after[j] - before[j]) / dt_s) : Affine(Affine::Zero());
}

}  // namespace bodice::rig
