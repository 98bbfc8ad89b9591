#include "landmarks/base/level_loop.hpp"

#include "landmarks/base/unchecked.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using geodesic::Field;
using geodesic::Isoline;

/// The distance from the fingertip, in units of hand to hand, beyond which no skin is an arm's.
constexpr float kArmLoopReach = 0.60F;

bool on_arm(const CoordinateArray& x) {
  return x[kOwnHand] < kArmLoopReach && kShoulder(x) > 0.0F;
}

/// Positive above the level; arms count as above, because they leave the trunk above all levels.
Field heights(const LandmarkInput& input, const Border& border) {
  constexpr float kAboveLevel = 1.0F;
  Field height(input.skin.mesh.positions.size());
  for (std::size_t v = 0; v < height.size(); ++v) {
    const CoordinateArray left = input.coordinates.at(v, 0), right = input.coordinates.at(v, 1);
    height[v] = on_arm(left) || on_arm(right) ? kAboveLevel : 0.5F * (border(left) + border(right));
  }
  return height;
}

FoundLandmark in_loop(const LandmarkInput& input, LandmarkId id, const Loop& loop) {
  return {{id, loop.center, loop.vertex, unchecked_confidence(input, loop.confidence)}, loop};
}

/// Holes cut a level into several open lines: the center and the length of all of them together.
void join_open_lines(const std::vector<Isoline>& lines, Loop& loop) {
  geometry::Vec3 moment = geometry::Vec3::Zero();
  double length = 0.0;
  for (const Isoline& line : lines) {
    if (line.closed) continue;
    moment += line.girth_m * line.centroid;
    length += line.girth_m;
  }
  if (!(length > 0.0)) return;
  loop.center = moment / length;
  loop.girth_m = length;
}

}  // namespace

Border level_border(LevelCoefficients coefficients, const Build& build) {
  Border border{};
  for (std::size_t i = 0; i < border.weight.size(); ++i)
    border.weight[i] = static_cast<float>(coefficients[i]);
  for (std::size_t i = 0; i < build.size(); ++i)
    border.weight[kCoordinateCount] += static_cast<float>(coefficients[kCoordinateCount + 1 + i]) * build[i];
  return border;
}

FoundLandmark find_limb_level(const LandmarkInput& input, LandmarkId left, int side, Coordinate end,
                              float reach, LevelCoefficients coefficients) {
  const Border border = level_border(coefficients, build_of(input.coordinates));
  return in_loop(input, body::of_side(left, side),
                 border_loop(input.skin, input.coordinates, {border, end, reach}, side));
}

FoundLandmark find_trunk_level(const LandmarkInput& input, LandmarkId id, LevelCoefficients coefficients) {
  const Field height = heights(input, level_border(coefficients, build_of(input.coordinates)));
  const float zero = 0.0F;
  const auto lines = geodesic::isolines(input.skin.mesh, input.skin.edges, height, {&zero, 1})[0];
  const Isoline* best = nullptr;
  for (const Isoline& line : lines)
    if (best == nullptr || line.girth_m > best->girth_m) best = &line;
  if (best == nullptr) return {};
  Loop loop{best->centroid, input.skin.edges.ends[best->edges[0]][0], best->girth_m,
            best->closed ? 1.0 : 0.5};
  if (!best->closed) join_open_lines(lines, loop);
  return in_loop(input, id, loop);
}

}  // namespace bodice::anatomy
