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
inline constexpr Border kHip{
    {0.0F, 0.0F, 0.0F, -1.0F, 0.2F, 0.1173F, 0.009827F, -0.05993F, -0.3402F, 0.0F, 0.2379F, 0.0F, 0.4598F}};
inline constexpr Border kWaist{{0.0F, -0.1565F, -0.1565F, 0.7137F, 0.7137F, -0.7648F, 0.06402F, 1.0F, 0.0F,
                                0.0F, -0.7954F, 0.0F, -0.06286F}};

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
    {1.01F, 0.0F, 0.0F, 0.3428F, 0.3916F, -0.01272F},
    {121.6F, 0.0F, 0.0F,   -1.755F, 1.474F, 38.92F,  0.0F, 60.27F, -0.6865F, 0.0F,   0.0F,    0.0F,
     0.0F,   0.0F, 14.45F, 0.0F,    0.0F,   0.0F,    0.0F, 0.0F,   0.0F,     32.39F, -14.42F, 20.35F,
     0.0F,   0.0F, 0.0F,   0.0F,    18.09F, -5.265F, 0.0F, 0.0F,   0.0F,     0.0F,   0.0F,    66.73F}};

/// Own hand, other hand, own foot, front, back, perineum, past the shoulder level; front minus back and front
/// plus back of half the chest's girth; detour between hand and foot.
inline constexpr Signature<10> kArmpit{
    {0.4211F, 0.6442F, 0.736F, 0.1831F, 0.1346F, 0.5902F, 0.001125F, 0.1949F, 1.676F, 1.025F},
    {84.91F, -10.45F, 4.298F, 45.71F,  -14.3F,   -6.62F,  -72.94F,  -3.422F, -0.7143F, 9.167F,
     0.0F,   51.97F,  6.507F, -14.89F, -27.64F,  -2.423F, -24.5F,   0.6407F, 0.07646F, -13.08F,
     0.0F,   0.0F,    27.67F, -2.442F, -0.8356F, -1.973F, -0.2646F, -1.723F, -0.0816F, 18.48F,
     0.0F,   0.0F,    0.0F,   75.73F,  -54.27F,  2.299F,  1.356F,   -10.21F, 0.2551F,  -28.57F,
     0.0F,   0.0F,    0.0F,   0.0F,    44.49F,   -9.111F, -5.124F,  5.849F,  -0.46F,   -2.294F,
     0.0F,   0.0F,    0.0F,   0.0F,    0.0F,     22.15F,  24.04F,   -3.114F, -0.7896F, -25.92F,
     0.0F,   0.0F,    0.0F,   0.0F,    0.0F,     0.0F,    61.94F,   -1.879F, -1.348F,  -21.66F,
     0.0F,   0.0F,    0.0F,   0.0F,    0.0F,     0.0F,    0.0F,     6.4F,    0.5725F,  18.92F,
     0.0F,   0.0F,    0.0F,   0.0F,    0.0F,     0.0F,    0.0F,     0.0F,    1.006F,   -13.4F,
     0.0F,   0.0F,    0.0F,   0.0F,    0.0F,     0.0F,    0.0F,     0.0F,    0.0F,     70.24F}};

}  // namespace bodice::anatomy
