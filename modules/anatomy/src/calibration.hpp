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

inline constexpr Border kNeck{
    {-1.0000F, 0.5847F, 0.5847F, 0.0000F, 0.0000F, -0.2463F, 0.0905F, 0.0000F, -0.4358F}};
inline constexpr Border kShoulder{
    {0.1145F, -1.0000F, 0.3448F, 0.0952F, 0.0000F, -0.1003F, 0.0643F, 0.2490F, -0.0731F}};
inline constexpr Border kElbow{
    {0.0000F, -1.0000F, 0.6712F, 0.0000F, 0.0000F, 0.0000F, 0.0000F, 0.0000F, -0.2360F}};
inline constexpr Border kKnee{
    {0.0000F, 0.0000F, 0.0000F, -1.0000F, 0.1524F, 0.0000F, 0.0000F, 0.0000F, 0.1961F}};
inline constexpr Border kHip{
    {0.0000F, 0.0000F, 0.0000F, -1.0000F, 0.4637F, 0.0839F, -0.0079F, -0.1032F, 0.2291F}};
inline constexpr Border kWaist{
    {-1.0000F, -0.1821F, -0.1821F, 0.6066F, 0.6066F, -0.1288F, 0.0503F, 0.3154F, -0.2007F}};

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
    {1.0112F, 0.0041803F, -0.0021551F, 0.33888F, 0.38808F},
    {117.98F,  19.122F,  -1.2065F, -10.711F, 4.5814F,  0.0F,     65.451F, -4.0746F, -0.60873F,
     0.60213F, 0.0F,     0.0F,     25.501F,  0.84678F, 0.26221F, 0.0F,    0.0F,     0.0F,
     31.353F,  -9.4816F, 0.0F,     0.0F,     0.0F,     0.0F,     19.322F}};

/// Own hand, other hand, own foot, front, back, perineum.
inline constexpr Signature<6> kArmpit{
    {0.42241F, 0.6371F, 0.73303F, 0.17925F, 0.11994F, 0.58964F},
    {50.292F,  -6.3439F, 2.004F,   24.953F, -24.23F, 1.4056F,  0.0F,    53.257F, 9.5417F,
     -2.1293F, -46.389F, -2.6307F, 0.0F,    0.0F,    29.501F,  -2.244F, 14.547F, -3.4921F,
     0.0F,     0.0F,     0.0F,     56.728F, -10.2F,  -10.483F, 0.0F,    0.0F,    0.0F,
     0.0F,     34.424F,  -7.5F,    0.0F,    0.0F,    0.0F,     0.0F,    0.0F,    25.836F}};

}  // namespace bodice::anatomy
