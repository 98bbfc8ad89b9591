// What one or two ellipsoids could be while all others stay: trials of a move before it is made.
#pragma once

#include <cstdint>
#include <vector>

#include <bodice/geometry/ellipsoid.hpp>

#include "tight_loss.hpp"

namespace bodice::fitting {

/// The samples that some ellipsoids may be the nearest of, structure of arrays.
struct Neighbourhood {
  std::vector<float> x, y, z;
  std::vector<float> target;  ///< distance to the skin
  std::vector<float> others;  ///< distance to the nearest of the other ellipsoids
  std::vector<std::uint8_t> one_sided;
  double cost = 0.0;  ///< with the ellipsoids that are there
};

/// A few damped steps of `ellipsoids` in place of those that the neighbourhood is of; returns what the cost
/// rises by.
double fit_locally(const Neighbourhood& samples, const TightLoss& loss,
                   std::vector<geometry::Ellipsoid>& ellipsoids);

}  // namespace bodice::fitting
