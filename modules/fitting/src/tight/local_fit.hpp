// Trials of split-and-merge moves: one or two ellipsoids are optimized while all others stay.
#pragma once

#include <cstdint>
#include <vector>

#include <bodice/geometry/ellipsoid.hpp>

#include "tight/normal_block.hpp"
#include "tight/robust_loss.hpp"

namespace bodice::inline v0_1::fitting {

/// The samples that one or two ellipsoids may own, structure of arrays.
struct Neighborhood {
  std::vector<float> x, y, z;
  std::vector<float> target;  ///< distance to the skin
  std::vector<float> others;  ///< distance to the nearest of the other ellipsoids
  std::vector<std::uint8_t> one_sided;
  double cost = 0.0;  ///< the sum of costs before the move

  void resize(std::size_t count);
};

/// Takes damped steps of ellipsoids that replace those of a neighborhood. The neighborhood must outlive it.
class LocalFit {
 public:
  LocalFit(const Neighborhood& samples, const RobustLoss& loss, std::vector<geometry::Ellipsoid> ellipsoids);

  void advance(int steps);
  /// The rise of the cost if these ellipsoids replace the others.
  double rise() const { return cost_ - samples_.cost; }
  const std::vector<geometry::Ellipsoid>& ellipsoids() const { return ellipsoids_; }

 private:
  /// Finds distances, owners and costs of the samples; returns the sum of the costs.
  double evaluate(const std::vector<geometry::Ellipsoid>& ellipsoids);
  NormalBlock normal_equations(std::size_t ellipsoid);

  const Neighborhood& samples_;
  const RobustLoss& loss_;
  std::vector<geometry::Ellipsoid> ellipsoids_;
  /// The results of evaluate().
  struct Assignment {
    std::vector<float> least;          ///< #samples: distance to the union
    std::vector<std::uint32_t> owner;  ///< #samples: #ellipsoids stands for one of the others
    std::vector<float> cost;           ///< #samples
  };
  Assignment now_, before_;
  std::vector<float> distance_;  ///< #samples, scratch
  BlockSamples mine_;
  double cost_ = 0.0, damping_;
};

}  // namespace bodice::fitting
