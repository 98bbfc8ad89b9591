// Where the places of a body lie in its own coordinates, as data.
// Borders were fitted by weighted least squares to labeled CC0 bodies (twelve builds, thin to obese,
// pregnant, children, in about ten poses each) and, with less weight, to made bodies. With each build left
// out in turn, they put 1 % of the skin of real bodies into the wrong part and 1 to 3 % of children and obese
// ones. Places were fitted to the same, to thirteen builds in twenty more poses, and to made bodies of other
// seeds than bench/anatomy and the tests use.
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

/// Beyond this distance from the head's end the sign of the neck's border means nothing; of the size.
inline constexpr float kHeadReach = 0.48F;

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

/// A place is the vertex whose N features lie nearest to what Z measures of the whole body lead to expect,
/// by the spread among bodies. Fitted in two steps: the mean and the spread of the features at the true
/// places, then descent on the distance from the truth, in units of its bar, of the place that is found.
template <int N, int Z>
struct Signature {
  std::array<float, N> mean;
  std::array<float, N * Z> of_body;         ///< row-major: how the features follow the measures of the body
  std::array<float, N*(N + 1) / 2> whiten;  ///< upper triangle by rows

  std::array<float, N> expected(const std::array<float, Z>& body) const {
    std::array<float, N> x = mean;
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < Z; ++j) x[i] += of_body[i * Z + j] * body[j];
    return x;
  }

  float distance2(const std::array<float, N>& x, const std::array<float, N>& expected) const {
    float sum = 0.0F;
    for (int i = 0, k = 0; i < N; ++i) {
      float y = 0.0F;
      for (int j = i; j < N; ++j) y += whiten[k++] * (x[j] - expected[j]);
      sum += y * y;
    }
    return sum;
  }
};

/// Both feet (of twice the way to where the legs merge), feet difference, hands difference (zero at the
/// crown), front, back, how far behind the merge of the legs, both hands, head, detour between head and feet.
/// Of the body: feet apart, hands apart, front and back at the merge.
inline constexpr Signature<9, 4> kPerineum{
    {1.088F, 0.0F, 0.0F, 0.2826F, 0.04773F, 0.0848F, 0.8931F, 1.877F, 0.8877F},
    {-0.03493F, -0.0467F, 0.04799F,  -0.03425F, 0.0F,      0.0F,    0.0F,     0.0F,      0.0F,
     0.0F,      0.0F,     0.0F,      -0.141F,   -0.06018F, 0.619F,  0.1246F,  -0.02367F, 0.01245F,
     0.2713F,   0.6959F,  -0.0284F,  -0.04263F, -0.2371F,  0.1428F, -0.1315F, -0.3058F,  0.5469F,
     0.2377F,   -1.193F,  -0.05826F, 0.1875F,   0.02341F,  0.161F,  -0.0762F, 0.1508F,   -0.003888F},
    {139.3F,  0.0F,    0.0F,    0.4289F, -0.8219F, 26.32F,  4.275F, 5.557F, 4.898F, 57.4F,   -5.772F, 0.0F,
     0.0F,    0.0F,    0.0F,    0.0F,    0.0F,     27.99F,  0.0F,   0.0F,   0.0F,   0.0F,    0.0F,    0.0F,
     50.57F,  -2.496F, -17.29F, -10.74F, -4.545F,  -15.06F, 38.53F, 24.08F, -4.4F,  -0.662F, -2.578F, 71.97F,
     -3.474F, -5.096F, -4.793F, 27.8F,   -1.545F,  14.17F,  42.35F, -38.9F, 58.36F}};

/// Own hand, other hand, own foot, front, back, perineum, past the shoulder level; front minus back and front
/// plus back of half the chest's girth; detour between hand and foot; other foot; detours between head and
/// hands, and head and feet; head. Of the body: half the chest's girth, hands apart, feet apart, trunk, front
/// and back at the crown.
inline constexpr Signature<14, 6> kArmpit{
    {0.6276F, 0.1235F, 2.5F, 0.1219F, -0.7044F, 0.6648F, 0.3306F, 4.618F, -3.168F, 1.19F, 2.136F, 0.193F,
     0.4489F, -0.1956F},
    {-0.3529F, -0.1359F,   0.01345F,  -0.007873F, -0.01438F, -0.02173F, -0.009292F, -0.03155F, 0.3636F,
     0.4377F,  -0.005714F, -0.3916F,  -0.1443F,   0.1092F,   -1.48F,    -0.1918F,   -0.5327F,  0.1301F,
     0.1309F,  0.07334F,   -0.0852F,  0.3597F,    -0.4008F,  -0.2036F,  -0.1102F,   0.1628F,   0.4394F,
     0.4982F,  0.3224F,    -0.5636F,  -0.07507F,  0.2299F,   -0.142F,   0.2406F,    -1.125F,   0.09267F,
     -0.1878F, -0.1526F,   -0.1142F,  -0.01184F,  -0.02903F, -0.01889F, 0.3625F,    -0.2169F,  -3.012F,
     -0.6102F, -4.193F,    1.674F,    -9.258F,    0.8478F,   3.501F,    5.777F,     -1.856F,   -2.601F,
     0.04889F, -0.0951F,   -0.04243F, -0.1037F,   0.146F,    -0.06643F, -0.04659F,  0.04292F,  -1.189F,
     0.0975F,  -0.4612F,   -0.05152F, -0.2368F,   0.1691F,   0.63F,     1.175F,     -0.8768F,  -0.7039F,
     -0.157F,  0.1855F,    0.3045F,   0.3128F,    -0.1753F,  -0.02054F, -0.08857F,  0.1253F,   0.05899F,
     0.468F,   0.3643F,    -0.05469F},
    {126.4F,   -8.506F, -9.107F, 32.42F,  -4.977F, 9.91F,   -95.41F,  -0.4716F, 0.3445F,   10.84F,  -5.252F,
     -14.94F,  -13.02F, 13.06F,  86.46F,  6.752F,  29.77F,  -46.0F,   -1.5F,    6.954F,    -1.074F, 0.08433F,
     -4.987F,  -12.23F, -30.41F, 10.49F,  5.84F,   84.43F,  -6.512F,  21.35F,   -5.426F,   10.79F,  1.122F,
     -0.1041F, -6.327F, 17.3F,   0.6371F, -76.33F, 70.19F,  109.0F,   -78.67F,  3.95F,     -3.132F, -12.61F,
     -0.8007F, -5.994F, 0.3189F, 3.12F,   -16.06F, -22.97F, 76.72F,   -9.228F,  23.48F,    8.037F,  -0.5896F,
     -30.58F,  0.6594F, -14.63F, 23.89F,  -45.32F, 43.46F,  -0.5277F, 0.03991F, -0.05644F, -16.01F, -14.66F,
     -3.956F,  -53.77F, 52.09F,  71.59F,  -1.351F, 0.1051F, -54.0F,   -10.36F,  -12.67F,   33.1F,   -2.955F,
     8.823F,   0.9579F, 56.74F,  -2.151F, -2.327F, -11.73F, 19.16F,   2.352F,   -22.18F,   -2.908F, -10.38F,
     7.105F,   -6.25F,  100.4F,  -18.69F, -8.146F, 11.04F,  25.0F,    80.68F,   -5.516F,   -81.74F, 67.34F,
     26.59F,   -14.52F, -44.97F, 53.47F,  -42.34F, 45.71F}};

}  // namespace bodice::anatomy
