// What one or two ellipsoids could be while all others stay: trials of a move before it is made.
#pragma once

#include <cstdint>
#include <vector>

#include <bodice/geometry/ellipsoid.hpp>

#include "tight/normal_block.hpp"
#include "tight/robust_loss.hpp"

namespace bodice::fitting {

/// The samples that some ellipsoids may be the nearest of, structure of arrays.
struct Neighborhood {
  std::vector<float> x, y, z;
  std::vector<float> target;  ///< distance to the skin
  std::vector<float> others;  ///< distance to the nearest of the other ellipsoids
  std::vector<std::uint8_t> one_sided;
  double cost = 0.0;  ///< with the ellipsoids that are there

  void resize(std::size_t count);
};

/// Damped steps of some ellipsoids in place of those that the neighborhood is of, which must outlive it.
class LocalFit {
 public:
  LocalFit(const Neighborhood& samples, const TightLoss& loss, std::vector<geometry::Ellipsoid> ellipsoids);

  void advance(int steps);
  /// What the cost rises by if the ellipsoids are put in place.
  double rise() const { return cost_ - samples_.cost; }
  const std::vector<geometry::Ellipsoid>& ellipsoids() const { return ellipsoids_; }

 private:
  /// Distances, owners and costs of the samples; returns the sum of the costs.
  double evaluate(const std::vector<geometry::Ellipsoid>& ellipsoids);
  NormalBlock normal_equations(std::size_t ellipsoid);

  const Neighborhood& samples_;
  const TightLoss& loss_;
  std::vector<geometry::Ellipsoid> ellipsoids_;
  /// What evaluate() finds.
  struct Assignment {
    std::vector<float> least;          ///< #samples: distance to the union
    std::vector<std::uint32_t> owner;  ///< #samples: #ellipsoids if it is one of the others
    std::vector<float> cost;           ///< #samples
  };
  Assignment now_, before_;
  std::vector<float> distance_;  ///< #samples, scratch
  BlockSamples mine_;
  double cost_ = 0.0, damping_;
};

}  // namespace bodice::fitting
