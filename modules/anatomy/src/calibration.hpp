// Where the places of a body lie in its own coordinates, as data.
// Borders were fitted by weighted least squares to labelled CC0 bodies (twelve builds, thin to obese,
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
    {1.084F, 0.0F, 0.0F, 0.2169F, 0.001886F, 0.09748F, 0.848F, 1.966F, 0.8511F},
    {-0.02737F, -0.05163F, 0.04633F,  -0.03391F, 0.0F,       0.0F,    0.0F,      0.0F,      0.0F,
     0.0F,      0.0F,      0.0F,      -0.1026F,  -0.05654F,  0.6828F, 0.1129F,   0.006328F, 0.004191F,
     0.2779F,   0.7475F,   -0.04557F, -0.03194F, -0.2686F,   0.1593F, -0.09819F, -0.3265F,  0.6109F,
     0.2515F,   -1.269F,   -0.05376F, 0.1849F,   -0.005409F, 0.1909F, -0.075F,   0.1789F,   -0.02517F},
    {148.1F,  0.0F,    0.0F,    1.31F,  -0.4647F, 27.08F,  7.565F,  20.24F,  -9.283F,
     58.33F,  -8.074F, 0.0F,    0.0F,   0.0F,     0.0F,    0.0F,    0.0F,    28.99F,
     0.0F,    0.0F,    0.0F,    0.0F,   0.0F,     0.0F,    80.48F,  -8.515F, -54.68F,
     -15.58F, -5.693F, -19.35F, 63.36F, 59.61F,   -7.954F, -1.743F, -6.588F, 83.34F,
     -7.967F, -11.9F,  -5.185F, 33.08F, -5.75F,   31.45F,  72.82F,  -76.64F, 62.2F}};

/// Own hand, other hand, own foot, front, back, perineum, past the shoulder level; front minus back and front
/// plus back of half the chest's girth; detour between hand and foot; other foot; detours between head and
/// hands, and head and feet; head. Of the body: half the chest's girth, hands apart, feet apart, trunk, front
/// and back at the crown.
inline constexpr Signature<14, 6> kArmpit{
    {0.6214F, 0.101F, 2.646F, 0.1676F, -0.7713F, 0.6909F, 0.3191F, 5.254F, -3.902F, 1.187F, 2.168F, 0.159F,
     0.4426F, -0.1928F},
    {-0.3339F, -0.162F,   0.0374F,   -0.009901F, 0.003502F, -0.03325F, -0.06374F, -0.0679F, 0.4196F,
     0.4354F,  0.05157F,  -0.4094F,  -0.1486F,   0.1504F,   -1.607F,   -0.2516F,  -0.5865F, 0.1401F,
     0.06639F, 0.08076F,  -0.1099F,  0.3231F,    -0.3615F,  -0.1936F,  -0.1786F,  0.1571F,  0.5033F,
     0.4744F,  0.4271F,   -0.5433F,  -0.07128F,  0.3309F,   -0.2159F,  0.1626F,   -1.102F,  0.08338F,
     -0.1649F, -0.183F,   -0.08321F, -0.01844F,  0.01407F,  -0.04127F, 0.3758F,   -0.1169F, -3.548F,
     -0.5905F, -4.818F,   1.701F,    -10.55F,    1.034F,    4.122F,    5.541F,    -0.8941F, -2.247F,
     0.06297F, -0.09293F, -0.04067F, -0.1193F,   0.1845F,   -0.08941F, -0.04577F, 0.08987F, -1.236F,
     0.04613F, -0.4236F,  -0.06328F, -0.3376F,   0.1515F,   0.6919F,   1.155F,    -0.8118F, -0.7059F,
     -0.2243F, 0.2391F,   0.282F,    0.2826F,    -0.1569F,  0.006638F, -0.1558F,  0.1344F,  0.05528F,
     0.4604F,  0.3888F,   -0.03476F},
    {133.0F,   -1.952F,  -17.33F, 28.5F,   -4.083F, 10.09F,  -99.17F, -0.2792F, 0.4521F, 16.3F,   -14.54F,
     -19.17F,  6.833F,   5.258F,  75.04F,  13.05F,  31.5F,   -41.1F,  -3.924F,  9.951F,  -1.419F, 0.02802F,
     1.408F,   -10.09F,  -29.21F, 7.344F,  8.402F,  108.3F,  -19.59F, 40.17F,   -1.384F, 13.74F,  4.094F,
     -0.2634F, -0.2652F, 47.2F,   -1.419F, -140.4F, 133.3F,  110.3F,  -79.73F,  0.818F,  -6.223F, -11.14F,
     -0.8307F, 12.38F,   -5.283F, 9.104F,  -11.11F, -43.69F, 69.4F,   -15.79F,  23.28F,  7.731F,  -0.2981F,
     -25.99F,  8.645F,   -11.63F, 27.16F,  -53.01F, 41.42F,  -3.089F, 0.9052F,  0.1523F, -11.22F, -8.124F,
     -4.786F,  -59.64F,  55.03F,  72.08F,  -1.818F, 0.3062F, -69.79F, -11.34F,  -16.24F, 37.81F,  -5.135F,
     7.459F,   0.9386F,  58.86F,  1.968F,  -4.27F,  -15.08F, 24.19F,  2.008F,   -26.43F, 1.202F,  -10.37F,
     2.233F,   0.2933F,  94.67F,  -23.67F, -13.25F, 18.08F,  37.92F,  80.36F,   -9.423F, -80.67F, 75.36F,
     25.7F,    -9.24F,   -38.8F,  48.74F,  -46.06F, 35.83F}};

}  // namespace bodice::anatomy
