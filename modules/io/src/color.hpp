#pragma once

#include <cmath>
#include <span>

#include <Eigen/Core>

namespace bodice::inline v0_1::io {

/// Converts sRGB 0..1 to linear light, the unit of glTF's colors and of the shading here. IEC 61966-2-1.
inline float to_linear(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

inline Eigen::Vector3f to_linear(std::span<const float, 3> srgb) {
  return {to_linear(srgb[0]), to_linear(srgb[1]), to_linear(srgb[2])};
}

}  // namespace bodice::io
