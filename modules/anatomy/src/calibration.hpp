// Where the places of a body lie in its own coordinates, as data.
// Fitted by weighted least squares to labelled CC0 bodies (twelve builds, thin to obese, pregnant, children,
// in about ten poses each) and, with less weight, to made bodies. With each build left out in turn, the
// borders put 1 % of the skin of real bodies into the wrong part and 1 to 3 % of children and obese ones.
// Borders are the label borders of those bodies' skin weights, so a joint's border runs through the joint. No
// coordinate that the borders use is a height or a share of the stature: a large head or short legs do not
// move them.
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
  kFromPerineum,
  kHandFootDetour,  ///< the way from hand over the vertex to the foot of its side, of the shortest
  kHeadHandDetour,  ///< the same between head and hands, mean of both
  kHeadFootDetour,  ///< the same between head and feet, mean of both
  kPastShoulder,    ///< beyond the level where the arm widens into the trunk
};
inline constexpr int kCoordinateCount = 12;
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

inline constexpr Border kNeck{
    {0.0F, 1.0F, 1.0F, 0.0F, 0.0F, -0.7486F, -0.07611F, 0.6189F, 0.0F, -0.5823F, -0.2196F, 0.0F, -0.5808F}};
inline constexpr Border kShoulder{{0.0F, -0.3639F, 0.5072F, 0.1697F, 0.0F, 0.09233F, 0.1485F, 0.0295F,
                                   -0.00845F, -0.3147F, 0.7794F, -1.0F, -0.814F}};
inline constexpr Border kElbow{
    {0.0F, -1.0F, 0.6874F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, -0.2495F}};
inline constexpr Border kKnee{
    {0.0F, 0.0F, 0.0F, -1.0F, 0.1758F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.1793F}};
inline constexpr Border kHip{{0.0F, 0.0F, 0.0F, -1.0F, 0.2604F, 0.1242F, -0.01634F, -0.08913F, -0.3157F, 0.0F,
                              0.2261F, 0.0F, 0.4227F}};
inline constexpr Border kWaist{{0.0F, -0.4515F, -0.4515F, 0.6917F, 0.6917F, -0.5644F, 0.2917F, 1.0F, 0.0F,
                                0.0F, -0.6587F, 0.0F, 0.08828F}};

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

/// Both feet (of twice the way to where the legs merge), feet difference, hands difference (zero at the
/// crown), front, back, how far behind the merge of the legs.
inline constexpr Signature<6> kPerineum{
    {1.009F, 0.0F, 0.0F, 0.3424F, 0.3823F, -0.008556F},
    {132.2F, 0.0F, 0.0F,   -4.952F, 1.839F, 47.75F,   0.0F, 63.53F, -1.72F, 0.0F,   0.0F,    0.0F,
     0.0F,   0.0F, 25.32F, 0.0F,    0.0F,   0.0F,     0.0F, 0.0F,   0.0F,   29.54F, -10.94F, 1.821F,
     0.0F,   0.0F, 0.0F,   0.0F,    18.58F, 0.07727F, 0.0F, 0.0F,   0.0F,   0.0F,   0.0F,    61.91F}};

/// Own hand, other hand, own foot, front, back, perineum, past the shoulder level; front minus back and front
/// plus back of half the chest's girth; detour between hand and foot.
inline constexpr Signature<10> kArmpit{
    {0.4205F, 0.641F, 0.7325F, 0.1784F, 0.1324F, 0.5866F, 0.0F, 0.1846F, 1.634F, 1.023F},
    {87.74F, -16.38F, 3.961F, 36.91F,  0.9461F, -5.423F, -84.11F, -2.365F,  -0.9948F, 9.132F,
     0.0F,   58.11F,  5.644F, -1.288F, -48.94F, -5.203F, -14.5F,  -0.9339F, 0.6058F,  -16.94F,
     0.0F,   0.0F,    29.92F, -12.85F, 11.09F,  -3.987F, -3.938F, 0.01677F, -0.1996F, 21.31F,
     0.0F,   0.0F,    0.0F,   80.72F,  -55.63F, 0.5363F, 4.07F,   -10.5F,   0.3526F,  -43.54F,
     0.0F,   0.0F,    0.0F,   0.0F,    49.97F,  -7.998F, -6.345F, 5.702F,   -0.8465F, -4.591F,
     0.0F,   0.0F,    0.0F,   0.0F,    0.0F,    25.08F,  23.37F,  -2.579F,  -0.8742F, -26.68F,
     0.0F,   0.0F,    0.0F,   0.0F,    0.0F,    0.0F,    67.64F,  -1.8F,    -1.116F,  -30.23F,
     0.0F,   0.0F,    0.0F,   0.0F,    0.0F,    0.0F,    0.0F,    5.947F,   0.8049F,  4.464F,
     0.0F,   0.0F,    0.0F,   0.0F,    0.0F,    0.0F,    0.0F,    0.0F,     1.217F,   -14.69F,
     0.0F,   0.0F,    0.0F,   0.0F,    0.0F,    0.0F,    0.0F,    0.0F,     0.0F,     66.94F}};

}  // namespace bodice::anatomy
