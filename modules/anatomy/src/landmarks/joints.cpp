#include "landmarks/joints.hpp"

#include "coordinates/body_lengths.hpp"

namespace bodice::anatomy {
namespace {

using geometry::Vec3;
using LengthShift = Shift<std::tuple_size_v<BodyLengths>>;

/// How much of the way from the neck's loop to the armpits' middle, and to the head's, the joint lies.
constexpr double kToArmpits = 0.4181, kToHead = 0.3958;
/// The body's lengths; the head's radius.
using NeckShift = Shift<std::tuple_size_v<BodyLengths> + 1>;
constexpr NeckShift kNeckUp{{0.2741, -0.1131, -0.2350, 0.1461, 0.1304, 0.0184, -0.5003}};
constexpr NeckShift kNeckForward{{0.0931, 0.0480, -0.0471, -0.1855, 0.1377, 0.0108, -0.1036}};

/// The same from the loop alone.
constexpr LengthShift kLoopUp{{0.3031, -0.1955, -0.2471, 0.3285, -0.267, 0.0198}};
constexpr LengthShift kLoopForward{{0.0629, -0.0832, -0.0867, 0.2431, -0.2025, -0.0099}};

/// Along the bone from the trunk, and along the bone to the limb's end.
struct LimbShift {
  LengthShift upper, lower;
};
constexpr LimbShift kElbowShift{{{-0.0324, 0.0180, 0.0423, -0.0315, 0.0009, -0.0107}},
                                {{-0.0436, 0.0345, 0.0269, -0.0358, 0.0019, 0.0012}}};
constexpr LimbShift kKneeShift{{{0.0275, -0.0065, -0.0587, 0.1050, -0.0471, -0.0381}},
                               {{-0.0108, 0.0017, -0.0516, 0.1098, -0.0756, 0.0365}}};

Vec3 limb_joint(const BodyCoordinates& coordinates, const Girth& loop, const Vec3& root, const Vec3& end,
                const LimbShift& shift) {
  if (loop.vertex == geometry::kNoIndex) return loop.center;
  const BodyLengths lengths = body_lengths(coordinates);
  const Vec3 upper = (loop.center - root).normalized(), lower = (end - loop.center).normalized();
  const auto size = static_cast<double>(coordinates.size_m());
  return loop.center + size * (shift.upper(lengths) * upper + shift.lower(lengths) * lower);
}

}  // namespace

Vec3 neck_joint(const Skin& skin, const BodyCoordinates& coordinates, const Landmarks& marks,
                const Ball& head) {
  const Vec3& loop = marks.neck.center;
  if (marks.neck.vertex == geometry::kNoIndex) return loop;
  const auto size = static_cast<double>(coordinates.size_m());
  const BodyLengths b = body_lengths(coordinates);
  const std::array<double, b.size() + 1> lengths{b[0], b[1], b[2], b[3], b[4], head.radius / size};
  const Vec3 up = (loop - skin.mesh.positions[marks.perineum]).normalized();
  const Vec3 through = coordinates.midline().front.position - coordinates.midline().back.position;
  const Vec3 forward = (through - through.dot(up) * up).normalized();
  const bool has_head = head.radius > 0.0;  // not where all of it is taken for something else
  if (skin.handles > 0 || !has_head) return loop + size * (kLoopUp(b) * up + kLoopForward(b) * forward);
  const Vec3 armpits = 0.5 * (marks.armpit_place[0] + marks.armpit_place[1]);
  return loop + kToArmpits * (armpits - loop) + kToHead * (head.center - loop) +
         size * (kNeckUp(lengths) * up + kNeckForward(lengths) * forward);
}

Vec3 elbow_joint(const BodyCoordinates& coordinates, const Girth& loop, const Vec3& root, const Vec3& end) {
  return limb_joint(coordinates, loop, root, end, kElbowShift);
}

Vec3 knee_joint(const BodyCoordinates& coordinates, const Girth& loop, const Vec3& root, const Vec3& end) {
  return limb_joint(coordinates, loop, root, end, kKneeShift);
}

}  // namespace bodice::anatomy
