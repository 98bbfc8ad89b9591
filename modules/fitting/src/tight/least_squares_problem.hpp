// Least squares between the union's signed distance and the skin's: state, residuals and normal equations.
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

namespace bodice::fitting {

/// A sample's nearest ellipsoids, ascending; infinitely far where it has fewer.
struct Nearest3 {
  std::array<std::uint32_t, 3> ellipsoid;
  std::array<float, 3> distance;
};

/// Samples in spatial order; each keeps the ellipsoids that can be its nearest until they have moved by
/// most_motion(), up to `candidates` of them.
class TightProblem {
 public:
  static constexpr int kNear = NearestCandidates::kMost;

  TightProblem(std::span<const DistanceSample> samples, const Scaling& scaling, const TightLoss& loss,
               double most_motion, int candidates = kNear);

  /// After refresh() no ellipsoid may move any point of its surface farther without another refresh().
  double most_motion() const { return most_motion_; }
  std::size_t sample_count() const { return target_.size(); }
  const TightLoss& loss() const { return loss_; }
  /// More samples; asks for a refresh().
  void add(std::span<const DistanceSample> samples);

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
  std::vector<Nearest3> rank(const engine::Context& context) const;  ///< #S
  /// The samples that one of `ellipsoids` (one or two, ascending) may be the nearest of, with the distance to
  /// the others.
  Neighborhood around(std::span<const std::uint32_t> ellipsoids, std::span<const Nearest3> ranked) const;
  /// Samples on or just off the skin, within 5 mm, by the ellipsoid that owns them and by part.
  std::vector<std::array<std::uint32_t, body::kPartCount>> skin_of_each() const;
  /// Fall of the cost since remember(), by ellipsoid (owner before or after).
  std::vector<double> gains() const;
  std::vector<NormalBlock> normal_equations(const engine::Context& context,
                                            std::span<const geometry::Ellipsoid> ellipsoids) const;

 private:
  void bound_blocks();
  void bound_block(std::size_t begin, std::size_t end);
  struct BlockFeet;
  void find_feet(const engine::Context& context, std::span<const FootEllipsoid> ellipsoids,
                 BlockFeet& feet) const;
  void choose_candidates(const engine::Context& context, std::span<const FootEllipsoid> ellipsoids);
  std::vector<std::uint32_t> count_pairs(const engine::Context& context);
  void number_pairs(const engine::Context& context, std::vector<std::uint32_t> next);
  void gather(std::size_t ellipsoid, BlockSamples& mine) const;

  Scaling scaling_;
  TightLoss loss_;
  double most_motion_;
  int candidates_;
  float reach_;  ///< two ellipsoids that move so far in all change places only within this
  std::array<std::vector<float>, 3> point_;        ///< #S
  std::vector<float> target_;                      ///< #S
  std::vector<std::uint8_t> one_sided_;            ///< #S
  std::vector<body::Part> part_;                   ///< #S
  std::array<std::vector<float>, 3> ball_center_;  ///< #blocks of neighboring samples
  std::vector<float> from_center_;                 ///< #S: distance to the center of the block's ball
  std::size_t ellipsoids_ = 0;
  std::vector<std::uint32_t> pair_begin_;   ///< #E + 1: pairs are grouped by ellipsoid
  std::vector<std::uint32_t> pair_sample_;  ///< #P
  std::array<std::vector<float>, 3> pair_point_;
  std::vector<float> distance_, previous_;                  ///< #P
  std::vector<std::array<std::uint32_t, kNear>> pairs_of_;  ///< #S
  std::vector<std::array<float, kNear>> found_at_;          ///< #S: distances as the pairs were chosen
  std::vector<std::uint8_t> count_of_;                      ///< #S: used slots of pairs_of_
  std::vector<std::uint32_t> ellipsoid_of_pair_;
  std::vector<std::uint32_t> owner_, remembered_owner_;  ///< #S: pairs
  std::vector<float> cost_, remembered_cost_;
};

}  // namespace bodice::fitting
