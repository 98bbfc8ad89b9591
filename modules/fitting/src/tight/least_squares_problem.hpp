// The least-squares problem between the union's signed distance and the skin's: state, residuals, normal
// equations.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/ellipsoid.hpp>

#include "base/scaling.hpp"
#include "skin/skin_samples.hpp"
#include "tight/local_fit.hpp"
#include "tight/nearest_candidates.hpp"
#include "tight/normal_block.hpp"
#include "tight/robust_loss.hpp"

namespace bodice::inline v0_1::fitting {

/// A sample's three nearest ellipsoids, ascending by distance. Where it has fewer candidates, the index is ~0
/// and the distance infinite.
struct Nearest3 {
  std::array<std::uint32_t, 3> ellipsoid;
  std::array<float, 3> distance;
};

/// Samples in spatial order, each with its candidates: up to `candidates` ellipsoids that can become its
/// nearest one before the ellipsoids have moved by most_motion().
class LeastSquaresProblem {
 public:
  static constexpr int kNear = NearestCandidates::kMost;

  LeastSquaresProblem(std::span<const DistanceSample> samples, const Scaling& scaling, const RobustLoss& loss,
                      double most_motion, int candidates = kNear);

  /// How far an ellipsoid's surface may move, in the scaled body, before another refresh() is due.
  double most_motion() const { return most_motion_; }
  std::size_t sample_count() const { return target_.size(); }
  const RobustLoss& loss() const { return loss_; }
  /// Adds samples. A refresh() has to follow.
  void add(std::span<const DistanceSample> samples);

  /// Chooses each sample's candidates afresh, and evaluates distances, owners and costs.
  void refresh(const engine::Context& context, std::span<const geometry::Ellipsoid> ellipsoids);
  /// Evaluates the distances of all pairs, and keeps the previous ones for restore().
  void evaluate(const engine::Context& context, std::span<const geometry::Ellipsoid> ellipsoids);
  /// Restores the previous distances of one ellipsoid.
  void restore(std::size_t ellipsoid);
  /// Finds the owner and the cost of each sample from the distances.
  void assign(const engine::Context& context);
  /// Keeps owners and costs for gains().
  void remember();

  /// The sum of all costs.
  double total() const;
  /// #S: the nearest ellipsoids of each sample.
  std::vector<Nearest3> rank(const engine::Context& context) const;
  /// The samples that have one of `ellipsoids` (one or two, ascending) among their candidates, with the
  /// distance to the nearest of the other ellipsoids.
  Neighborhood around(std::span<const std::uint32_t> ellipsoids, std::span<const Nearest3> ranked) const;
  /// #E: the number of samples within 5 mm of the skin that an ellipsoid owns, by part.
  std::vector<std::array<std::uint32_t, body::kAllPartCount>> skin_of_each() const;
  /// #E: the fall of the cost since remember() over the samples that the ellipsoid owned then or owns now.
  std::vector<double> gains() const;
  /// #E: the normal equations of each ellipsoid over the samples that it owns.
  std::vector<NormalBlock> normal_equations(const engine::Context& context,
                                            std::span<const geometry::Ellipsoid> ellipsoids) const;

 private:
  void bound_blocks();
  void bound_block(std::size_t begin, std::size_t end);
  struct BlockDistances;
  void measure_centers(const engine::Context& context, std::span<const FloatEllipsoid> ellipsoids,
                       BlockDistances& centers) const;
  void choose_candidates(const engine::Context& context, std::span<const FloatEllipsoid> ellipsoids);
  std::vector<std::uint32_t> count_pairs(const engine::Context& context);
  void number_pairs(const engine::Context& context, std::vector<std::uint32_t> next);
  void gather(std::size_t ellipsoid, BlockSamples& mine) const;

  Scaling scaling_;
  RobustLoss loss_;
  double most_motion_;
  int candidates_;
  float reach_;  ///< twice most_motion_: an ellipsoid farther than this behind the nearest one cannot become
                 ///< nearest
  std::array<std::vector<float>, 3> point_;  ///< #S
  std::vector<float> target_;                ///< #S
  std::vector<std::uint8_t> one_sided_;      ///< #S
  std::vector<body::Part> part_;             ///< #S
  std::array<std::vector<float>, 3>
      ball_center_;                 ///< #blocks: the center of a ball around a block of samples
  std::vector<float> from_center_;  ///< #S: distance to the center of its block's ball
  std::size_t ellipsoids_ = 0;
  std::vector<std::uint32_t> pair_begin_;                   ///< #E + 1: pairs are grouped by ellipsoid
  std::vector<std::uint32_t> pair_sample_;                  ///< #P
  std::array<std::vector<float>, 3> pair_point_;            ///< #P: copies of the samples' points
  std::vector<float> distance_, previous_;                  ///< #P
  std::vector<std::array<std::uint32_t, kNear>> pairs_of_;  ///< #S
  std::vector<std::array<float, kNear>> found_at_;          ///< #S: distances when the pairs were chosen
  std::vector<std::uint8_t> count_of_;                      ///< #S: used slots of pairs_of_
  std::vector<std::uint32_t> ellipsoid_of_pair_;            ///< #P
  std::vector<std::uint32_t> owner_, remembered_owner_;     ///< #S: the pair with the owner
  std::vector<float> cost_, remembered_cost_;               ///< #S
};

}  // namespace bodice::fitting
