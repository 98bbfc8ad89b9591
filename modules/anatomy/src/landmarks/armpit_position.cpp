#include "landmarks/armpit_position.hpp"

#include <algorithm>
#include <cmath>

#include "coordinates/build.hpp"
#include "skin/linear_form.hpp"

namespace bodice::anatomy {
namespace {

using geometry::Vec3;

/// Outward to the armpit's side, up and forward: a frame of the trunk.
struct TrunkFrame {
  Vec3 out, up, forward;
  Vec3 of(const Vec3& v) const { return {v.dot(out), v.dot(up), v.dot(forward)}; }
};

/// Seen from an armpit: the direction of its arm and the products of two of its coordinates, but the first's
/// square; the build; and, of the size, armpit to armpit and the ways through space to the neck's joint, to
/// the breastbone and to the back.
constexpr std::size_t kOfArm = 8, kOfPlaces = 10;
using ArmMeasures = std::array<double, kOfArm + std::tuple_size_v<Build> + kOfPlaces>;
using ArmForm = LinearForm<std::tuple_size_v<ArmMeasures>>;

/// How far the armpit lies outward, up and forward of the first answer, of the size. Least squares, the
/// farther off the more weight, over 26 real bodies, 409 skinned to a rig (mixes of six builds and beyond the
/// heaviest, in 15 and in random poses) and the made bodies of seeds 910000..910999. Of 199 rig-skinned
/// bodies of other builds and poses one armpit misses its bar in place of 6.
constexpr ArmForm kOutward{{-0.1105, 0.0080,  0.0020, 0.0004, 0.0002, 0.0004, 0.0097,  0.0015,  0.0032,
                            0.0035,  0.0392,  0.0014, 0.0442, 0.0192, 0.0175, -0.0210, 0.0567,  0.1327,
                            0.0412,  -0.0437, 0.1147, 0.2676, 0.0681, 0.0264, 0.0320,  -0.0444, 0.0006}};
constexpr ArmForm kUpward{{0.2084,  -0.0005, -0.0002, -0.0068, -0.0042, 0.0020,  0.0067,  -0.0012, -0.0050,
                           0.0350,  -0.1227, -0.0720, -0.0310, -0.0167, 0.2509,  -0.0305, -0.1623, -0.1933,
                           -0.2960, -0.0711, 0.2241,  0.0623,  0.3612,  -0.0126, -0.0909, 0.0223,  -0.0018}};
constexpr ArmForm kForward{{-0.0619, 0.0040,  0.0023,  0.0007, -0.0014, 0.0032, 0.0045, -0.0021, 0.0062,
                            0.0188,  0.0008,  -0.0905, 0.0992, 0.0265,  0.0232, 0.0309, 0.0474,  0.0479,
                            -0.1890, -0.0192, 0.0080,  0.3270, 0.0088,  0.1564, 0.0810, 0.0448,  -0.0001}};
/// Ninety-eight of a hundred of these bodies measure between these, behind the arm's direction; beyond,
/// nothing more is learned.
constexpr std::array<double, std::tuple_size_v<ArmMeasures> - kOfArm> kLeast{
    0.808,  0.993, 0.515, 0.252,  0.277,  0.177, 0.152,  0.548,  0.161,
    -0.170, 0.036, 0.012, -0.171, -0.005, 0.051, -0.173, -0.015, -0.071},
    kMost{1.090,  1.141, 0.751, 0.495,  0.528, 0.371, 0.426,  0.768, 0.340,
          -0.079, 0.138, 0.060, -0.072, 0.070, 0.123, -0.074, 0.149, 0.108};
/// The largest that any of them needs is .027.
constexpr double kFarthest = 0.03;

TrunkFrame trunk_frame(const Landmarks& marks, int side) {
  const Vec3 up = (marks.neck_place - marks.perineum_place).normalized();
  const Vec3 across = marks.armpit_place[0] - marks.armpit_place[1];
  const Vec3 left = (across - across.dot(up) * up).normalized();
  return {side == 0 ? left : Vec3(-left), up, left.cross(up)};
}

ArmMeasures measures_of(const BodyCoordinates& coordinates, const Landmarks& marks, int side,
                        const TrunkFrame& frame) {
  const auto size = static_cast<double>(coordinates.size_m());
  const Vec3& armpit = marks.armpit_place[side];
  const Vec3 arm = frame.of((marks.elbow_place[side] - armpit).normalized());
  ArmMeasures x{arm.x(),           arm.y(),           arm.z(),           arm.x() * arm.y(),
                arm.x() * arm.z(), arm.y() * arm.y(), arm.y() * arm.z(), arm.z() * arm.z()};
  std::size_t next = kOfArm;
  for (const float length : build_of(coordinates)) x[next++] = static_cast<double>(length);
  x[next++] = (marks.armpit_place[0] - marks.armpit_place[1]).norm() / size;
  const Midline& middle = coordinates.midline();
  for (const Vec3& place : {marks.neck_place, middle.front.position, middle.back.position})
    for (const double way : frame.of(place - armpit)) x[next++] = way / size;
  for (std::size_t i = kOfArm; i < x.size(); ++i)
    x[i] = std::clamp(x[i], kLeast[i - kOfArm], kMost[i - kOfArm]);
  return x;
}

Vec3 armpit_by_arm(const BodyCoordinates& coordinates, const Landmarks& marks, int side) {
  const TrunkFrame frame = trunk_frame(marks, side);
  const ArmMeasures x = measures_of(coordinates, marks, side, frame);
  const Vec3 shift(kOutward(x), kUpward(x), kForward(x));
  if (!shift.allFinite()) return marks.armpit_place[side];
  const auto limited = [](double s) { return std::clamp(s, -kFarthest, kFarthest); };
  return marks.armpit_place[side] + static_cast<double>(coordinates.size_m()) *
                                        (limited(shift.x()) * frame.out + limited(shift.y()) * frame.up +
                                         limited(shift.z()) * frame.forward);
}

}  // namespace

std::array<Vec3, 2> armpits_by_arms(const Skin& skin, const BodyCoordinates& coordinates,
                                    const Landmarks& marks) {
  if (skin.handles > 0) return marks.armpit_place;
  return {armpit_by_arm(coordinates, marks, 0), armpit_by_arm(coordinates, marks, 1)};
}

}  // namespace bodice::anatomy
