// Least squares between the union's signed distance and the skin's: state, residuals and normal equations.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/ellipsoid.hpp>

#include "skin_samples.hpp"

namespace bodice::fitting {

/// How residuals (union distance - skin distance) are counted. Lengths in units of the scaled problem.
struct TightLoss {
  float huber = 0.003f;  ///< squared below, linear above
  float uncovered_huber = 0.003f;
  float uncovered_weight = 1.0f;  ///< of skin and interior that the union leaves outside
  float ignore_depth = 0.008f;    ///< deeper samples that are inside ask nothing
  float far = 0.030f;             ///< samples farther outside ask only not to be nearer than they are
};

/// One ellipsoid's normal equations: centre, log radii, rotation vector.
struct NormalBlock {
  using Matrix = Eigen::Matrix<double, 9, 9>;
  using Vector = Eigen::Matrix<double, 9, 1>;
  Matrix jtj = Matrix::Zero();
  Vector jtr = Vector::Zero();
};

/// Samples sorted for vector code: each keeps its kNear nearest ellipsoids as candidates.
class TightProblem {
 public:
  static constexpr int kNear = 6;
  static constexpr std::uint32_t kNoOwner = ~0u;

  TightProblem(std::span<const DistanceSample> samples, const Vec3& origin, double scale,
               const TightLoss& loss);

  std::size_t sample_count() const { return target_.size(); }

  /// Chooses each sample's candidates afresh and evaluates everything.
  void refresh(const engine::Context& context, std::span<const geometry::Ellipsoid> ellipsoids);
  /// Distances of every candidate pair; keeps the previous ones for restore().
  void evaluate(const engine::Context& context, std::span<const geometry::Ellipsoid> ellipsoids);
  /// Puts back the previous distances of one ellipsoid.
  void restore(std::size_t ellipsoid);
  /// Active ellipsoid and cost of each sample from the distances.
  void assign(const engine::Context& context);
  /// Keeps the assignment for gains().
  void remember();

  double total() const;
  std::span<const std::uint32_t> owner() const { return owner_; }
  /// Cost by owner, and what each ellipsoid's removal would add.
  std::vector<double> cost_of_each() const;
  std::vector<double> use_of_each() const;
  /// Owned samples on or just off the skin, within 5 mm.
  std::vector<std::size_t> skin_of_each() const;
  /// #S: the ellipsoid that a sample counts for in skin_of_each(), or kNoOwner.
  std::vector<std::uint32_t> skin_owner() const;
  /// Fall of the cost since remember(), by ellipsoid (owner before or after).
  std::vector<double> gains() const;
  std::vector<NormalBlock> normal_equations(const engine::Context& context,
                                            std::span<const geometry::Ellipsoid> ellipsoids) const;

 private:
  float cost_at(std::size_t sample, float distance) const;

  TightLoss loss_;
  std::array<std::vector<float>, 3> point_;  ///< #S
  std::vector<float> target_;                ///< #S
  std::vector<std::uint8_t> one_sided_;      ///< #S
  std::size_t ellipsoids_ = 0;
  std::vector<std::uint32_t> pair_begin_;   ///< #E + 1: pairs are grouped by ellipsoid
  std::vector<std::uint32_t> pair_sample_;  ///< #P
  std::array<std::vector<float>, 3> pair_point_;
  std::vector<float> distance_, previous_;                  ///< #P
  std::vector<std::array<std::uint32_t, kNear>> pairs_of_;  ///< #S, unused slots repeat the first
  std::vector<std::uint32_t> ellipsoid_of_pair_;
  std::vector<std::uint32_t> owner_, remembered_owner_;
  std::vector<float> cost_, second_cost_, remembered_cost_, residual_;
};

}  // namespace bodice::fitting
