// Borders in the body's coordinates, and those through joints.
#pragma once

#include <algorithm>
#include <array>

#include <coefficients/joint_borders.hpp>

namespace bodice::inline v0_1::anatomy {

/// The coordinates of a vertex, seen from one side of the body; see BodyCoordinates.
enum Coordinate {
  kFromHead,
  kOwnHand,
  kOtherHand,
  kOwnFoot,
  kOtherFoot,
  kFromFront,
  kFromBack,
  kFromPerineum,
  kHandFootDetour,  ///< the path from hand over the vertex to the foot of its side, as a multiple of the
                    ///< shortest
  kHeadHandDetour,  ///< the same between head and hands, mean of both
  kHeadFootDetour,  ///< the same between head and feet, mean of both
  kPastShoulder,    ///< beyond the level where the arm widens into the trunk
};
inline constexpr int kCoordinateCount = 12;
using CoordinateArray = std::array<float, kCoordinateCount>;

/// The zero line of weight . coordinates + constant; positive on the side of the limb's end.
struct Border {
  std::array<float, kCoordinateCount + 1> weight;

  float operator()(const CoordinateArray& x) const {
    float sum = weight[kCoordinateCount];
    for (int i = 0; i < kCoordinateCount; ++i) sum += weight[i] * x[i];
    return sum;
  }
};

/// Coefficients in single precision, as the borders and signatures use them.
template <std::size_t N>
constexpr std::array<float, N> to_floats(const double (&values)[N]) {
  std::array<float, N> floats{};
  for (std::size_t i = 0; i < N; ++i) floats[i] = static_cast<float>(values[i]);
  return floats;
}

/// The distance from the head's tip beyond which the sign of the neck's border means nothing; a fraction of
/// the body size.
inline constexpr float kHeadReach = 0.48F;

// These are read by landmarks; parts have borders of their own (segment/part_borders.hpp).
// Borders follow the labels of skin weights, so that a joint's border runs through the joint. No coordinate
// that they use is a height or a share of the stature: a large head or short legs do not move them.
inline constexpr Border kNeck{to_floats(coefficients::joint_borders::kNeck)};
inline constexpr Border kShoulder{to_floats(coefficients::joint_borders::kShoulder)};
inline constexpr Border kElbow{to_floats(coefficients::joint_borders::kElbow)};
inline constexpr Border kKnee{to_floats(coefficients::joint_borders::kKnee)};

}  // namespace bodice::anatomy
