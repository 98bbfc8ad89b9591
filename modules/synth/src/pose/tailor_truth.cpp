// Differs from anatomy's measurements: read on the rest pose, in which the trunk is upright (thighs: with the
// legs of the A pose), from the numbers that the body was made from; anatomy's are read on any mesh from what
// was found on it.
#include "pose/tailor_truth.hpp"

#include <algorithm>
#include <cmath>

#include "pose/deform.hpp"
#include "pose/tailor_points.hpp"

namespace bodice::inline v0_1::synth {
namespace {

using body::LandmarkId;
using body::MeasurementId;
using Vec2 = Eigen::Vector2d;

double cross(const Vec2& o, const Vec2& a, const Vec2& b) {
  return (a.x() - o.x()) * (b.y() - o.y()) - (a.y() - o.y()) * (b.x() - o.x());
}

// Based on: A. M. Andrew. Another efficient algorithm for convex hulls in two dimensions. 1979.
std::vector<Vec2> half_hull(const std::vector<Vec2>& sorted) {
  std::vector<Vec2> hull;
  for (const Vec2& p : sorted) {
    while (hull.size() >= 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0.0) hull.pop_back();
    hull.push_back(p);
  }
  return hull;
}

double length_of(const std::vector<Vec2>& line) {
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length;
}

/// The length of a line below a height y, by many small steps.
double length_behind(const std::vector<Vec2>& line, double y) {
  constexpr int kSteps = 64;
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i)
    for (int k = 0; k < kSteps; ++k) {
      const Vec2 middle = line[i - 1] + (k + 0.5) / kSteps * (line[i] - line[i - 1]);
      if (middle.y() < y) length += (line[i] - line[i - 1]).norm() / kSteps;
    }
  return length;
}

/// A tape around a cut: x to the left, y to the front.
struct Tape {
  std::vector<Vec2> points;        ///< of the cut, sorted by x
  double girth = 0.0, back = 0.0;  ///< back: what lies behind the middle of the cut's depth
};

Tape tape(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  Tape t;
  std::vector<Vec2> hull = half_hull(points);
  const std::vector<Vec2> reversed(points.rbegin(), points.rend());
  const std::vector<Vec2> front = half_hull(reversed);
  hull.insert(hull.end(), front.begin(), front.end());
  t.girth = length_of(hull);
  if (hull.empty()) return t;
  const auto [least, most] = std::minmax_element(hull.begin(), hull.end(),
                                                 [](const Vec2& a, const Vec2& b) { return a.y() < b.y(); });
  t.back = length_behind(hull, 0.5 * (least->y() + most->y()));
  t.points = std::move(points);
  return t;
}

Tape trunk_tape(const Posed& rest, double height) {
  std::vector<Vec2> points;
  walk_section(rest, Vec3(0.0, height, 0.0), Vec3::UnitY(), [&](const Vec3& one, const Vec3& other) {
    points.emplace_back(one.x(), one.z());
    points.emplace_back(other.x(), other.z());
  });
  return tape(std::move(points));
}

/// The girth of a thigh just below the crotch, on a body that stands with its legs as in the A pose: they are
/// closer together than those of the rest pose, so that a plane across a thigh meets it lower.
double thigh_girth(const Posed& b, int side) {
  constexpr double kBelow =
      0.012;  // a fraction of the stature: as little as keeps the plane below the crotch
  const BoneTransforms bones = pose_figure(b.figure, Pose::kA, 0);
  const std::vector<Vec3> standing = deform({}, b.rest, b.weights, bones);
  const Vec3 perineum = true_landmarks({b.figure, b.mesh, b.triangles, b.rest, b.weights, standing,
                                        bones})[static_cast<std::size_t>(LandmarkId::kPerineum)]
                            .position;
  const LimbAxes& axes = b.figure.leg[side];
  const auto turned = [&](const Vec3& v) {
    return Vec3(bones[index(of_side(Bone::kThighL, side))].linear() * v);
  };
  const Vec3 along = turned(axes.along), out = turned(axes.out), front = turned(axes.front);
  const double sign = side == 0 ? 1.0 : -1.0;
  std::vector<Vec2> points;
  walk_section({b.figure, b.mesh, b.triangles, standing, b.weights, standing, bones},
               perineum + kBelow * along, along, [&](const Vec3& one, const Vec3& other) {
                 for (const Vec3* p : {&one, &other})
                   if (sign * (*p - perineum).x() > 0.0) points.emplace_back(p->dot(out), p->dot(front));
               });
  return tape(std::move(points)).girth;
}

/// The girth of a wrist at its joint.
double wrist_girth(const Posed& rest, int side) {
  const LimbAxes& axes = rest.figure.arm[side];
  const Vec3 origin = rest.figure.joint[index(of_side(Bone::kHandL, side))];
  const Region arm = region_of_side(Region::kArmL, side);
  std::vector<Vec2> points;
  for (const geometry::Triangle& t : rest.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec3 &p = rest.rest[t[k]], &q = rest.rest[t[(k + 1) % 3]];
      const double one = (p - origin).dot(axes.along), other = (q - origin).dot(axes.along);
      if (rest.mesh.region[t[k]] != arm || rest.mesh.region[t[(k + 1) % 3]] != arm ||
          (one > 0.0) == (other > 0.0))
        continue;
      const Vec3 at = p + one / (one - other) * (q - p);
      points.emplace_back(at.dot(axes.out), at.dot(axes.front));
    }
  return tape(std::move(points)).girth;
}

/// The foremost point of a tape at this x.
double front_at(const Tape& tape, double x) {
  std::vector<Vec2> reversed(tape.points.rbegin(), tape.points.rend());
  const std::vector<Vec2> front = half_hull(reversed);
  for (std::size_t i = 1; i < front.size(); ++i)
    if (front[i].x() <= x && x <= front[i - 1].x()) {
      const double share = (x - front[i].x()) / std::max(1e-12, front[i - 1].x() - front[i].x());
      return front[i].y() + share * (front[i - 1].y() - front[i].y());
    }
  return 0.0;
}

double hindmost_x(const Tape& tape, double sign) {
  double x = 0.0, least = 1e9;
  for (const Vec2& p : tape.points)
    if (sign * p.x() > 0.0 && p.y() < least) {
      least = p.y();
      x = p.x();
    }
  return x;
}

double width(const Tape& tape) {
  return tape.points.empty() ? 0.0 : tape.points.back().x() - tape.points.front().x();
}

void measure_trunk(const Posed& rest, body::Measurements& m) {
  const TailorLevels levels = tailor_levels(rest.figure);
  const Tape bust = trunk_tape(rest, levels.bust), waist = trunk_tape(rest, levels.waist),
             hip = trunk_tape(rest, levels.hip);
  m[MeasurementId::kBust] = bust.girth;
  m[MeasurementId::kBackWidth] = bust.back;
  m[MeasurementId::kUnderbust] = trunk_tape(rest, levels.underbust).girth;
  m[MeasurementId::kWaist] = waist.girth;
  m[MeasurementId::kWaistBackWidth] = waist.back;
  m[MeasurementId::kHips] = hip.girth;
  m[MeasurementId::kHipBackWidth] = hip.back;
  m[MeasurementId::kHipsLine] = levels.waist - levels.hip;
  m[MeasurementId::kHipInclination] =
      std::atan2(0.5 * (width(hip) - width(waist)), levels.waist - levels.hip);
  m[MeasurementId::kBumPoints] = hindmost_x(hip, 1.0) - hindmost_x(hip, -1.0);
}

}  // namespace

body::Measurements true_measurements(const Posed& b, const std::vector<body::Landmark>& posed_landmarks) {
  BoneTransforms still;
  still.fill(Eigen::Isometry3d::Identity());
  const Posed rest{b.figure, b.mesh, b.triangles, b.rest, b.weights, b.rest, still};
  const std::vector<body::Landmark> landmarks = true_landmarks(rest);
  const auto at = [&](LandmarkId left, int side) {
    return landmarks[static_cast<std::size_t>(body::of_side(left, side))].position;
  };
  const TailorLevels levels = tailor_levels(b.figure);
  body::Measurements m;
  measure_trunk(rest, m);
  const Vec3 side = at(LandmarkId::kNeckSideL, 0), shoulder = at(LandmarkId::kShoulderL, 0),
             bust = at(LandmarkId::kBustL, 0), perineum = at(LandmarkId::kPerineum, 0);
  m[MeasurementId::kHeight] = 1.0;
  m[MeasurementId::kHeadLength] = 1.0 - at(LandmarkId::kNeckBack, 0).y();
  m[MeasurementId::kNeckWidth] = (side - at(LandmarkId::kNeckSideL, 1)).norm();
  m[MeasurementId::kShoulderWidth] = (shoulder - at(LandmarkId::kShoulderL, 1)).norm();
  m[MeasurementId::kShoulderInclination] = std::asin((side.y() - shoulder.y()) / (side - shoulder).norm());
  m[MeasurementId::kArmLength] = (at(LandmarkId::kElbowL, 0) - shoulder).norm() +
                                 (at(LandmarkId::kWristL, 0) - at(LandmarkId::kElbowL, 0)).norm();
  m[MeasurementId::kArmscyeDepth] = shoulder.y() - at(LandmarkId::kArmpitL, 0).y();
  m[MeasurementId::kWrist] = wrist_girth(rest, 0);
  m[MeasurementId::kBustLine] = (side - bust).norm();
  m[MeasurementId::kVerticalBustLine] = side.y() - bust.y();
  m[MeasurementId::kBustPoints] = (bust - at(LandmarkId::kBustL, 1)).norm();
  m[MeasurementId::kWaistLine] = at(LandmarkId::kNeckBack, 0).y() - levels.waist;
  const Vec3 below(bust.x(), levels.waist, front_at(trunk_tape(rest, levels.waist), bust.x()));
  m[MeasurementId::kWaistOverBustLine] = (side - bust).norm() + (bust - below).norm();
  m[MeasurementId::kCrotchHipDifference] = levels.hip - perineum.y();
  m[MeasurementId::kLegCircumference] = thigh_girth(b, 0);
  double angle = 0.0;
  for (int s = 0; s < 2; ++s) {
    const auto posed = [&](LandmarkId left) {
      return posed_landmarks[static_cast<std::size_t>(body::of_side(left, s))].position;
    };
    const Vec3 arm = posed(LandmarkId::kWristL) - posed(LandmarkId::kShoulderL);
    angle += 0.5 * std::asin(-arm.y() / arm.norm());
  }
  m[MeasurementId::kArmPoseAngle] = angle;
  return m;
}

}  // namespace bodice::synth
