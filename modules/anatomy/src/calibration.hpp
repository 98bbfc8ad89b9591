// Where the places of a body lie in its own coordinates, as data.
// Fitted by weighted least squares to labelled CC0 bodies: twelve builds (thin to obese, pregnant, children)
// in about ten poses each; judged with each build left out in turn. Borders are the label borders of those
// bodies' skin weights, so a joint's border runs through the joint.
#pragma once

#include <array>

namespace bodice::anatomy {

/// The coordinates of a vertex, seen from one side of the body; see BodyCoordinates.
enum Coordinate {
  kFromHead,
  kOwnHand,
  kOtherHand,
  kOwnFoot,
  kOtherFoot,
  kFromFront,
  kFromBack,
  kFromPerineum
};
inline constexpr int kCoordinateCount = 8;
using CoordinateArray = std::array<float, kCoordinateCount>;

/// A border is the zero line of weight . coordinates + constant; positive on the side of the limb's end.
struct Border {
  std::array<float, kCoordinateCount + 1> weight;

  float operator()(const CoordinateArray& x) const {
    float sum = weight[kCoordinateCount];
    for (int i = 0; i < kCoordinateCount; ++i) sum += weight[i] * x[i];
    return sum;
  }
};

inline constexpr Border kNeck{{-1.0F, 0.5847F, 0.5847F, 0.0F, 0.0F, -0.2463F, 0.0905F, 0.0F, -0.4358F}};
inline constexpr Border kShoulder{
    {0.1162F, -1.0F, 0.3432F, 0.09648F, 0.0F, -0.1022F, 0.06307F, 0.2477F, -0.07219F}};
inline constexpr Border kElbow{{0.0F, -1.0F, 0.6712F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, -0.236F}};
inline constexpr Border kKnee{{0.0F, 0.0F, 0.0F, -1.0F, 0.1524F, 0.0F, 0.0F, 0.0F, 0.1961F}};
inline constexpr Border kHip{{0.0F, 0.0F, 0.0F, -1.0F, 0.4695F, 0.08566F, -0.008306F, -0.1068F, 0.2259F}};
inline constexpr Border kWaist{
    {-1.0F, -0.1818F, -0.1818F, 0.606F, 0.606F, -0.1374F, 0.05014F, 0.3229F, -0.2008F}};

/// A place is the vertex whose features lie nearest to the mean, by the spread among bodies.
template <int N>
struct Signature {
  std::array<float, N> mean;
  std::array<float, N * N> whiten;  ///< upper triangular, row-major: the Cholesky factor of the precision

  float distance2(const std::array<float, N>& x) const {
    float sum = 0.0F;
    for (int i = 0; i < N; ++i) {
      float y = 0.0F;
      for (int j = i; j < N; ++j) y += whiten[i * N + j] * (x[j] - mean[j]);
      sum += y * y;
    }
    return sum;
  }
};

/// Both feet, feet difference, hands difference (zero at the crown), front, back.
inline constexpr Signature<5> kPerineum{
    {1.011F, 0.0F, 0.0F, 0.3389F, 0.3881F},
    {113.3F, 0.0F, 0.0F, -10.11F, 4.229F, 0.0F,   62.97F,  -3.542F, 0.0F, 0.0F, 0.0F, 0.0F,  25.44F,
     0.0F,   0.0F, 0.0F, 0.0F,    0.0F,   31.35F, -9.482F, 0.0F,    0.0F, 0.0F, 0.0F, 19.32F}};

/// Own hand, other hand, own foot, front, back, perineum.
inline constexpr Signature<6> kArmpit{
    {0.4224F, 0.6371F, 0.733F, 0.1792F, 0.1199F, 0.5892F},
    {50.36F, -6.498F, 1.919F, 24.52F,  -24.35F, 2.103F,  0.0F, 53.3F, 9.556F, -1.931F, -46.3F,  -2.933F,
     0.0F,   0.0F,    29.47F, -2.411F, 14.58F,  -3.272F, 0.0F, 0.0F,  0.0F,   56.77F,  -9.882F, -10.67F,
     0.0F,   0.0F,    0.0F,   0.0F,    34.65F,  -8.152F, 0.0F, 0.0F,  0.0F,   0.0F,    0.0F,    25.97F}};

}  // namespace bodice::anatomy
