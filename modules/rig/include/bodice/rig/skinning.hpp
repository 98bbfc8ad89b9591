// Skin weights, and the skin posed by them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/rig/skeleton.hpp>

namespace bodice::inline v0_1::rig {

/// Which joints move a vertex, and how much: entries first[v] to first[v + 1] belong to vertex v. Any number
/// of joints a vertex, at least one.
struct SkinWeights {
  std::vector<std::uint32_t> first;  ///< #V + 1
  std::vector<std::uint16_t> joint;  ///< #entries
  std::vector<float> weight;         ///< #entries, positive, of each vertex with sum 1

  std::size_t vertices() const { return first.empty() ? 0 : first.size() - 1; }
};

/// Checks the table's shape (#V = `vertices`), that joints exist and weights are finite and not negative.
/// Mends: drops entries of weight 0, merges those of one joint, and divides by the sum. Sums further than
/// kWeightSum from 1 are reported once, with the number of vertices. Fails with kUnusableGeometry where a
/// vertex has no weight. `weights` is unchanged on failure. O(#entries).
engine::Result<std::vector<engine::Warning>> mend(SkinWeights& weights, const Skeleton& skeleton,
                                                  std::size_t vertices);

/// What carries the bound skin to the pose: world[j] * bind[j]^-1 of each joint, #J. Allocates nothing.
void skinning_matrices(const Skeleton& skeleton, std::span<const Affine> world, std::span<Affine> skinning);

/// Linear blend skinning: posed[v] = sum of weight * skinning[joint] * rest[v]. #V each; `posed` may be
/// `rest`. Thread-safe, allocates nothing. Precondition: mended weights of #V vertices, #J skinning matrices.
void skin_linear(std::span<const Vec3> rest, const SkinWeights& weights, std::span<const Affine> skinning,
                 std::span<Vec3> posed);
/// The same by all workers of the context, with the same bits for any number of them. Throws Canceled.
void skin_linear(const engine::Context& context, std::span<const Vec3> rest, const SkinWeights& weights,
                 std::span<const Affine> skinning, std::span<Vec3> posed);

/// The map that linear blend skinning applies to one vertex: the weighted sum of its joints' skinning
/// matrices.
Affine blended_matrix(const SkinWeights& weights, std::size_t vertex, std::span<const Affine> skinning);

/// A skinning matrix in two factors: first a symmetric stretch (scale, shear, reflection), then a rigid
/// motion as the dual quaternion real + epsilon dual.
struct DualQuaternion {
  Quaternion real = Quaternion::Identity();
  Quaternion dual = Quaternion(0.0, 0.0, 0.0, 0.0);
  Mat3 stretch = Mat3::Identity();
};

/// Decomposes each skinning matrix, #J. A matrix that is singular gets the nearest rotation. Allocates
/// nothing.
void dual_quaternions(std::span<const Affine> skinning, std::span<DualQuaternion> out);

/// Dual quaternion skinning, which keeps the volume of twisted and bent joints. Stretches are blended
/// linearly and applied first. Same shapes and promises as skin_linear.
void skin_dual_quaternion(std::span<const Vec3> rest, const SkinWeights& weights,
                          std::span<const DualQuaternion> motion, std::span<Vec3> posed);
/// The same by all workers of the context, with the same bits for any number of them. Throws Canceled.
void skin_dual_quaternion(const engine::Context& context, std::span<const Vec3> rest,
                          const SkinWeights& weights, std::span<const DualQuaternion> motion,
                          std::span<Vec3> posed);

/// Rates of change of skinning matrices, 1/s, between two poses dt_s apart, #J. Given to skin_linear()
/// instead of skinning matrices, they give the mean velocity of each vertex, m/s. A dt_s that is not positive
/// gives zeros.
void skinning_rates(std::span<const Affine> before, std::span<const Affine> after, double dt_s,
                    std::span<Affine> rates);

}  // namespace bodice::rig
