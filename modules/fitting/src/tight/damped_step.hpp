// One step of one ellipsoid of the anytime optimization.
#pragma once

#include "tight/normal_block.hpp"

namespace bodice::inline v0_1::fitting {

constexpr double kFirstDamping = 1e-2;
/// Over-relaxation: steps of single blocks are too short, because neighbors move as well. A much larger
/// factor needs more steps to settle than it saves.
constexpr double kOverStep = 1.6;

/// An ellipsoid after a step.
struct DampedStep {
  geometry::Ellipsoid ellipsoid;
  double motion = 0.0;  ///< bound on the change of its distance at any point
};

/// Takes a damped Gauss-Newton step times `over_step`, shortened so that its motion is at most `most_motion`.
DampedStep damped_step(const geometry::Ellipsoid& ellipsoid, const NormalBlock& block, double damping,
                       double most_motion, double over_step = kOverStep);

}  // namespace bodice::fitting
