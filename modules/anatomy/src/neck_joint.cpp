#include "neck_joint.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace bodice::anatomy {
namespace {

using geometry::Vec3;

/// Constant; hand to hand, head to feet, head to hands, breastbone to crown, back to crown: the shift, of the
/// size. Least squares over the calibration bodies.
using Shift = std::array<double, 6>;
constexpr Shift kUp{0.3031, -0.1955, -0.2471, 0.3285, -0.267, 0.0198};
constexpr Shift kForward{0.0629, -0.0832, -0.0867, 0.2431, -0.2025, -0.0099};
/// No body needs more; beyond, the lengths are not those of a body.
constexpr double kMostShift = 0.05;

double shift(const Shift& weight, const std::array<double, 5>& lengths) {
  double sum = weight[0];
  for (std::size_t i = 0; i < lengths.size(); ++i) sum += weight[i + 1] * lengths[i];
  return std::isfinite(sum) ? std::clamp(sum, -kMostShift, kMostShift) : 0.0;
}

}  // namespace

Vec3 neck_joint(const Skin& skin, const BodyCoordinates& coordinates, const Girth& loop) {
  if (loop.vertex == geometry::kNoIndex) return loop.center;
  const BodyEnds& ends = coordinates.ends();
  const auto size = static_cast<double>(coordinates.size_m());
  const auto of_size = [&](float length_m) { return static_cast<double>(length_m) / size; };
  const std::array<double, 5> lengths{
      of_size(ends.hands_apart), of_size(ends.head_to_feet),
      of_size(0.5F * ((*ends.from_head)[ends.hand[0]] + (*ends.from_head)[ends.hand[1]])),
      of_size(coordinates.from_front()[ends.head]), of_size(coordinates.from_back()[ends.head])};
  const Vec3 up = (loop.center - skin.mesh.positions[coordinates.perineum()]).normalized();
  const Vec3 through = coordinates.midline().front.position - coordinates.midline().back.position;
  const Vec3 forward = (through - through.dot(up) * up).normalized();
  return loop.center + size * (shift(kUp, lengths) * up + shift(kForward, lengths) * forward);
}

}  // namespace bodice::anatomy
