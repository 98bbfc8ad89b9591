// Differs from the paper's section 2.2: a border is the zero line of a weighted sum of distances instead of
// one distance's isoline, so that it runs as anatomy does (the groin slants, the shoulder stands upright) and
// stays a smooth closed loop in any pose.
#include "segment/segment.hpp"

#include <algorithm>
#include <limits>

#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/mesh_distance.hpp>

#include "segment/part_borders.hpp"
#include "skin/small_components.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using body::Part;

constexpr std::size_t kGrain = 2048;
/// The distances from the limb's end beyond which a border's sign means nothing.
constexpr float kArmReach = 0.60F, kLegReach = 0.66F;
/// A thigh is nearer to its foot than to the other by at least this fraction of foot to foot: what lies
/// between is the floor of the trunk. Among 900 bodies none had a vertex of the other thigh nearer by more
/// than .022; on a later one it was .033, which the hands correct.
constexpr float kBetweenThighs = 0.03F;
/// How much a margin toward the other side's hand takes from a foot's margin: a leg raised forward stretches
/// the seat behind it, which then lies nearer to the foot of the leg that stands.
constexpr float kHandAgainstFoot = 0.5F;
constexpr double kAnywhere = std::numeric_limits<double>::infinity();

Part on_side(Part left, int side) {
  return static_cast<Part>(static_cast<int>(left) + side);
}

/// How much nearer the head lies to the left hand than to the right, as a fraction of hand to hand.
float tilt_of(const BodyExtremities& tips) {
  return ((*tips.from_hand[1])[tips.head] - (*tips.from_hand[0])[tips.head]) / tips.hands_apart;
}

/// How much nearer a vertex lies to the foot of a leg than to the other, as a fraction of foot to foot; less
/// if the hands contradict it.
float foot_margin(const CoordinateArray& x, float tilt) {
  const float by_hands = x[kOtherHand] - x[kOwnHand] - tilt;
  return x[kOtherFoot] - x[kOwnFoot] + kHandAgainstFoot * std::min(0.0F, by_hands);
}

/// `tilt`: of tilt_of().
Part part_of(const BodyCoordinates& coordinates, const PartBorders& border, float tilt, std::size_t v) {
  const CoordinateArray x[2] = {coordinates.at(v, 0), coordinates.at(v, 1)};
  if (x[0][kFromHead] < kHeadReach && border.neck(x[0]) > 0.0F) return Part::kHead;
  const int arm = x[1][kOwnHand] < x[0][kOwnHand], leg = x[1][kOwnFoot] < x[0][kOwnFoot];
  if (x[arm][kOwnHand] < kArmReach && border.shoulder(x[arm]) > 0.0F)
    return on_side(border.elbow(x[arm]) > 0.0F ? Part::kForearmL : Part::kUpperArmL, arm);
  const float margin = foot_margin(x[leg], leg == 0 ? tilt : -tilt);
  if (x[leg][kOwnFoot] < kLegReach && margin > kBetweenThighs && border.hip(x[leg]) > 0.0F)
    return on_side(border.knee(x[leg]) > 0.0F ? Part::kCalfL : Part::kThighL, leg);
  const int side = x[1][kOwnHand] + x[1][kOwnFoot] < x[0][kOwnHand] + x[0][kOwnFoot];
  if (border.waist(x[0]) <= 0.0F) return on_side(Part::kTorsoLL, side);
  return on_side(border.chest(x[0]) > 0.0F ? Part::kTorsoUL : Part::kTorsoML, side);
}

/// Eyes, teeth, clothes and debris follow the closest point of the skin of the body.
void attach_pieces(const engine::Context& context, const Skin& skin, std::vector<Part>& part) {
  if (skin.components < 2) return;
  geometry::TriMesh body{skin.mesh.positions, {}};
  for (const auto& t : skin.mesh.triangles)
    if (skin.component[t[0]] == 0) body.triangles.push_back(t);
  const geometry::MeshDistance distance(context, body);
  engine::parallel_for(context, part.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (skin.component[v] == 0) continue;
      const geometry::SurfacePoint at =
          distance.closest_point_within(skin.mesh.positions[v], kAnywhere).value_or(geometry::SurfacePoint{});
      if (at.triangle != geometry::kNoIndex) part[v] = part[body.triangles[at.triangle][0]];
    }
  });
}

}  // namespace

std::vector<Part> segment(const engine::Context& context, const Skin& skin,
                          const BodyCoordinates& coordinates) {
  std::vector<Part> part(skin.mesh.positions.size());
  const PartBorders border = part_borders(build_of(coordinates));
  const float tilt = tilt_of(coordinates.extremities());
  engine::parallel_for(context, part.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      if (skin.component[v] == 0) part[v] = part_of(coordinates, border, tilt, v);
  });
  absorb_small_components(skin, part);
  attach_pieces(context, skin, part);
  return part;
}

}  // namespace bodice::anatomy
