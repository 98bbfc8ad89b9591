// One step of one ellipsoid of the anytime optimization.
#pragma once

#include "tight/normal_block.hpp"

namespace bodice::fitting {

constexpr double kFirstDamping = 1e-2;
/// Neighbors give way to each other: what each block asks for is too short. Much more than this needs more
/// steps to settle than it saves.
constexpr double kOverStep = 1.6;

struct TightStep {
  geometry::Ellipsoid ellipsoid;
  double motion = 0.0;  ///< its distance changes by no more, at any point
};

/// A damped Gauss-Newton step times `over_step`, shortened so that its motion is at most `most_motion`.
TightStep damped_step(const geometry::Ellipsoid& ellipsoid, const NormalBlock& block, double damping,
                      double most_motion, double over_step = kOverStep);

}  // namespace bodice::fitting
