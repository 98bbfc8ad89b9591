#include "posture/leg.hpp"

#include <algorithm>
#include <cmath>

#include "posture/turns.hpp"

namespace bodice::inline v0_1::rigging {
namespace {

/// Rear end of the sole behind the ankle, as a multiple of the distance from the ankle to the ball.
constexpr double kHeelOverBall = 0.22;

/// The frame with the given x axis and -y along the bone.
Mat3 bone_frame(const Vec3& x, const Vec3& along) {
  Mat3 frame;
  frame << x, -along, x.cross(-along);
  return frame;
}

}  // namespace

PlacedFoot place_foot(const LegLengths& leg, const FootPosture& posture, double leg_m) {
  const Mat3 heading = about_y(posture.yaw);
  PlacedFoot foot;
  foot.frame = heading * about_x(-posture.pitch);
  const Vec3 heel(0.0, leg.ball.y(), -kHeelOverBall * leg.ball.z());
  const Vec3& pivot = posture.pitch > 0.0 ? heel : leg.ball;
  const Vec3 flat_ankle = leg_m * posture.ground + Vec3(0.0, leg.ankle_height, 0.0);
  foot.ankle = flat_ankle + heading * pivot - foot.frame * pivot;
  return foot;
}

LegPose solve_leg(const LegLengths& leg, const Vec3& hip, const PlacedFoot& foot, const Vec3& knee_front) {
  const Vec3 to_ankle = foot.ankle - hip;
  const double a = leg.thigh, b = leg.calf;
  const double d = std::clamp(to_ankle.norm(), std::abs(a - b) + 1e-6 * a, (1.0 - 1e-9) * (a + b));
  const Vec3 along = to_ankle.normalized();
  const Vec3 x = knee_front.cross(along).normalized();
  const double cosine = std::clamp((a * a + d * d - b * b) / (2.0 * a * d), -1.0, 1.0);
  const Vec3 thigh = cosine * along + std::sqrt(1.0 - cosine * cosine) * along.cross(x);
  const Vec3 calf = (d * along - a * thigh).normalized();
  return {bone_frame(x, thigh), bone_frame(x, calf), foot.frame, foot.frame};
}

}  // namespace bodice::rigging
