#include "tight/damped_step.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace bodice::inline v0_1::fitting {
namespace {

constexpr double kMinRadius = 0.002;  // least radius, in the scaled body

/// A bound on how much a step changes the distance at any point. Distances to convex bodies differ by no more
/// than their support functions do: a shift changes these by its length, radii by their largest change, and a
/// turn about an axis by the difference of the two radii across the axis.
double motion_of(const geometry::Vec3& radii, const NormalBlock::Vector& step) {
  const geometry::Vec3 mixed(radii[1] - radii[2], radii[2] - radii[0], radii[0] - radii[1]);
  return step.head<3>().norm() + radii.cwiseProduct(step.segment<3>(3)).cwiseAbs().maxCoeff() +
         mixed.cwiseProduct(step.tail<3>()).cwiseAbs().sum();
}

}  // namespace

DampedStep damped_step(const geometry::Ellipsoid& e, const NormalBlock& block, double damping,
                       double most_motion, double over_step) {
  NormalBlock::Matrix a = block.jtj;
  const double typical = a.trace() / 9.0;
  for (int j = 0; j < 9; ++j) a(j, j) += damping * (a(j, j) + 0.005 * typical) + 1e-4 * typical + 1e-12;
  NormalBlock::Vector step = -a.ldlt().solve(block.jtr);
  if (!step.allFinite()) return {e};
  step *= over_step;
  const double motion = motion_of(e.radii, step);
  if (motion > most_motion) step *= most_motion / motion;
  geometry::Ellipsoid next = e;
  next.center += step.head<3>();
  next.radii = (e.radii.array() * (1.0 + step.segment<3>(3).array().max(-0.5))).max(kMinRadius);
  const geometry::Vec3 turn = step.tail<3>();
  const double angle = turn.norm();
  if (angle > 0.0) next.axes = e.axes * Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  return {next, std::min(motion, most_motion)};
}

}  // namespace bodice::fitting
