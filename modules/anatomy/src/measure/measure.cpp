#include <bodice/anatomy/measure.hpp>

#include <algorithm>
#include <cmath>

#include "measure/tape.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using body::LandmarkId;
using body::MeasurementId;
using body::Part;
using geometry::Vec3;

/// A body stands if its axis from the ankles to the neck is this near to that of its trunk.
constexpr double kStands_rad = 0.3;
/// The girth of a thigh is taken this far below the perineum, a fraction of the stature: as little as keeps
/// the plane below the crotch.
constexpr double kBelowCrotch = 0.012;

constexpr std::array kTrunkParts{Part::kTorsoUL, Part::kTorsoUR, Part::kTorsoML, Part::kTorsoMR,
                                 Part::kTorsoLL, Part::kTorsoLR, Part::kThighL,  Part::kThighR};

/// One body with the axes that its lengths are measured along.
class Tailor {
 public:
  Tailor(const geometry::TriMesh& skin, const Anatomy& anatomy) : skin_(skin), anatomy_(anatomy) {
    up_ = anatomy.up.normalized();
    const Vec3 standing = (at(LandmarkId::kNeck) - middle(LandmarkId::kAnkleL)).normalized();
    if (standing.dot(up_) > std::cos(kStands_rad)) up_ = standing;
    const Vec3 across = at(LandmarkId::kShoulderL, 0) - at(LandmarkId::kShoulderL, 1);
    left_ = (across - across.dot(up_) * up_).normalized();
    front_ = left_.cross(up_);
  }

  body::Measurements all() const {
    body::Measurements m;
    if (!complete()) return m;
    measure_lengths(m);
    measure_arms(m);
    measure_trunk(m);
    m[MeasurementId::kLegCircumference] = 0.5 * (thigh_girth(0) + thigh_girth(1));
    return m;
  }

 private:
  const Vec3& at(LandmarkId left, int side = 0) const {
    return anatomy_.landmarks[static_cast<std::size_t>(body::of_side(left, side))].position;
  }
  Vec3 middle(LandmarkId left) const { return 0.5 * (at(left, 0) + at(left, 1)); }
  bool complete() const {
    return std::ranges::all_of(anatomy_.landmarks,
                               [](const body::Landmark& m) { return m.vertex != geometry::kNoIndex; });
  }
  /// The mean over both sides of what `of_side` gives for a side.
  template <class OfSide>
  double mean(OfSide of_side) const {
    return 0.5 * (of_side(0) + of_side(1));
  }
  double height(const Vec3& upper, const Vec3& lower) const { return (upper - lower).dot(up_); }

  void measure_lengths(body::Measurements& m) const {
    m[MeasurementId::kHeight] = anatomy_.stature_m;
    m[MeasurementId::kHeadLength] = height(at(LandmarkId::kCrown), at(LandmarkId::kNeckBack));
    m[MeasurementId::kNeckWidth] = (at(LandmarkId::kNeckSideL, 0) - at(LandmarkId::kNeckSideL, 1)).norm();
    m[MeasurementId::kShoulderWidth] = (at(LandmarkId::kShoulderL, 0) - at(LandmarkId::kShoulderL, 1)).norm();
    m[MeasurementId::kShoulderInclination] = mean(
        [&](int s) { return below_level(at(LandmarkId::kNeckSideL, s), at(LandmarkId::kShoulderL, s)); });
    m[MeasurementId::kBustPoints] = (at(LandmarkId::kBustL, 0) - at(LandmarkId::kBustL, 1)).norm();
    m[MeasurementId::kBustLine] =
        mean([&](int s) { return (at(LandmarkId::kNeckSideL, s) - at(LandmarkId::kBustL, s)).norm(); });
    m[MeasurementId::kVerticalBustLine] =
        mean([&](int s) { return height(at(LandmarkId::kNeckSideL, s), at(LandmarkId::kBustL, s)); });
    m[MeasurementId::kWaistLine] = height(at(LandmarkId::kNeckBack), at(LandmarkId::kWaist));
    m[MeasurementId::kHipsLine] = height(at(LandmarkId::kWaist), at(LandmarkId::kHip));
    m[MeasurementId::kCrotchHipDifference] = height(at(LandmarkId::kHip), at(LandmarkId::kPerineum));
  }

  void measure_arms(body::Measurements& m) const {
    m[MeasurementId::kArmLength] = mean([&](int s) {
      return (at(LandmarkId::kElbowL, s) - at(LandmarkId::kShoulderL, s)).norm() +
             (at(LandmarkId::kWristL, s) - at(LandmarkId::kElbowL, s)).norm();
    });
    m[MeasurementId::kArmPoseAngle] =
        mean([&](int s) { return below_level(at(LandmarkId::kShoulderL, s), at(LandmarkId::kWristL, s)); });
    m[MeasurementId::kArmscyeDepth] =
        mean([&](int s) { return height(at(LandmarkId::kShoulderL, s), at(LandmarkId::kArmpitL, s)); });
    m[MeasurementId::kWrist] = mean([&](int s) {
      return limb_girth(of_side(Part::kForearmL, s), at(LandmarkId::kWristL, s),
                        at(LandmarkId::kWristL, s) - at(LandmarkId::kElbowL, s));
    });
  }

  void measure_trunk(body::Measurements& m) const {
    const CutPlane waist_plane = level(at(LandmarkId::kWaist));
    const std::vector<CutPoint> hip_cut = trunk_cut(level(at(LandmarkId::kHip)));
    const Tape bust(trunk_cut(level(middle(LandmarkId::kBustL)))), waist(trunk_cut(waist_plane)),
        hip(hip_cut);
    if (!bust.found() || !waist.found() || !hip.found()) return;
    m[MeasurementId::kBust] = bust.girth();
    m[MeasurementId::kBackWidth] = bust.back_length();
    m[MeasurementId::kUnderbust] = Tape(trunk_cut(level(at(LandmarkId::kUnderbust)))).girth();
    m[MeasurementId::kWaist] = waist.girth();
    m[MeasurementId::kWaistBackWidth] = waist.back_length();
    m[MeasurementId::kHips] = hip.girth();
    m[MeasurementId::kHipBackWidth] = hip.back_length();
    m[MeasurementId::kHipInclination] =
        std::atan2(hip.half_width() - waist.half_width(), m[MeasurementId::kHipsLine]);
    m[MeasurementId::kBumPoints] = hindmost(hip_cut, 1.0) - hindmost(hip_cut, -1.0);
    m[MeasurementId::kWaistOverBustLine] = mean([&](int s) {
      const Vec3& bust_point = at(LandmarkId::kBustL, s);
      const double left = (bust_point - waist_plane.origin).dot(left_);
      const Vec3 below = waist_plane.origin + left * left_ + waist.front_at(left) * front_;
      return (at(LandmarkId::kNeckSideL, s) - bust_point).norm() + (bust_point - below).norm();
    });
  }

  /// The angle of a line below the horizontal.
  double below_level(const Vec3& from, const Vec3& to) const {
    return std::asin(std::clamp(height(from, to) / (from - to).norm(), -1.0, 1.0));
  }
  static Part of_side(Part left, int side) { return side == 0 ? left : body::mirrored(left); }
  CutPlane level(const Vec3& origin) const { return {origin, up_, left_, front_}; }
  std::vector<CutPoint> trunk_cut(const CutPlane& plane) const {
    return cut(skin_, anatomy_.part, kTrunkParts, plane);
  }
  /// How far to the left the rearmost point of the left (sign 1) or right (sign -1) half of a cut lies.
  double hindmost(const std::vector<CutPoint>& points, double sign) const {
    CutPoint best{0.0, std::numeric_limits<double>::infinity()};
    const double middle_line = (at(LandmarkId::kPerineum) - at(LandmarkId::kHip)).dot(left_);
    for (const CutPoint& p : points)
      if (sign * (p.left - middle_line) > 0.0 && p.front < best.front) best = p;
    return best.left;
  }
  double limb_girth(Part part, const Vec3& origin, const Vec3& along) const {
    const Vec3 normal = along.normalized();
    const Vec3 one = (std::abs(normal.dot(front_)) < 0.7 ? front_ : left_).cross(normal).normalized();
    const std::array parts{part};
    return Tape(cut(skin_, anatomy_.part, parts, {origin, normal, one, normal.cross(one)})).girth();
  }
  /// The girth of a thigh where it leaves the trunk. The skin above the border of the thigh belongs to the
  /// trunk.
  double thigh_girth(int side) const {
    const Vec3& perineum = at(LandmarkId::kPerineum);
    const Vec3 root = at(LandmarkId::kHip) + (side == 0 ? 1.0 : -1.0) * kHipHalf * anatomy_.stature_m * left_;
    const Vec3 normal = (at(LandmarkId::kKneeL, side) - root).normalized();
    const Vec3 left = (left_ - left_.dot(normal) * normal).normalized();
    const CutPlane plane{perineum + kBelowCrotch * anatomy_.stature_m * normal, normal, left,
                         left.cross(-normal)};
    std::vector<CutPoint> points = trunk_cut(plane);
    std::erase_if(points, [&](const CutPoint& p) { return (side == 0) != (p.left > 0.0); });
    return Tape(points).girth();
  }
  /// How far from the middle the thighs' axes pass the level of the hips, a fraction of the stature.
  static constexpr double kHipHalf = 0.052;

  const geometry::TriMesh& skin_;
  const Anatomy& anatomy_;
  Vec3 up_, left_, front_;
};

}  // namespace

body::Measurements measure(const geometry::TriMesh& skin, const Anatomy& anatomy) {
  return Tailor(skin, anatomy).all();
}

}  // namespace bodice::anatomy
