// The ball that a piece of skin resembles.
#pragma once

#include <cmath>

#include "skin/skin.hpp"

namespace bodice::inline v0_1::anatomy {

/// A ball by its center and its radius, in meters.
struct Ball {
  geometry::Vec3 center = geometry::Vec3::Zero();
  double radius = 0.0;  ///< root of the mean square distance from the center
};

/// The ball that a piece of skin resembles: area-weighted middle and spread of the triangles with three
/// corners that belong. O(#F).
template <class Belongs>
Ball ball_of(const Skin& skin, Belongs belongs) {
  const auto over = [&](auto add) {
    for (std::size_t f = 0; f < skin.mesh.triangles.size(); ++f) {
      const auto& t = skin.mesh.triangles[f];
      if (belongs(t[0]) && belongs(t[1]) && belongs(t[2])) add(t, geometry::area_vector(skin.mesh, f).norm());
    }
  };
  const auto& p = skin.mesh.positions;
  Ball ball;
  double weight = 0.0, square = 0.0;
  over([&](const geometry::Triangle& t, double area) {
    ball.center += area / 3.0 * (p[t[0]] + p[t[1]] + p[t[2]]);
    weight += area;
  });
  if (!(weight > 0.0)) return ball;
  ball.center /= weight;
  over([&](const geometry::Triangle& t, double area) {
    square += area * (p[t[0]] - ball.center).squaredNorm();
  });
  ball.radius = std::sqrt(square / weight);
  return ball;
}

/// A head is a ball; a mouth that the skin lines is nearer to its middle than this part of its radius.
inline constexpr double kOuterHead = 0.7;

}  // namespace bodice::anatomy
