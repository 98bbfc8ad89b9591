#include "landmarks/base/border_loop.hpp"

#include <algorithm>
#include <limits>

#include "skin/curve.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using geodesic::Field;
using geodesic::Isoline;

float least_on(const Skin& skin, const Isoline& loop, const Field& field) {
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < loop.points.size(); ++i)
    least = std::min(least, value_at(skin, loop, i, field));
  return least;
}

float mean_on(const Skin& skin, const Isoline& loop, const Field& field) {
  float sum = 0.0F;
  for (std::size_t i = 0; i < loop.points.size(); ++i) sum += value_at(skin, loop, i, field);
  return sum / static_cast<float>(loop.points.size());
}

const Field& distances_from_end(const BodyExtremities& tips, Coordinate end, int side) {
  if (end == kFromHead) return *tips.from_head;
  return end == kOwnHand ? *tips.from_hand[side] : *tips.from_foot[side];
}

/// The border's value near the limb's end; outside everywhere else.
Field scores(const Skin& skin, const BodyCoordinates& coordinates, const BorderOfLimb& wanted, int side) {
  constexpr float kOutside = -1e-6F;
  const Field& from = distances_from_end(coordinates.extremities(), wanted.end, side);
  const float no_neighbor = wanted.reach * coordinates.unit_of(wanted.end) + 2.0F * skin.graph.longest;
  Field score(skin.mesh.positions.size(), kOutside);
  for (std::size_t v = 0; v < score.size(); ++v) {
    if (!(from[v] < no_neighbor)) continue;
    const CoordinateArray x = coordinates.at(v, side);
    const float s = wanted.border(x) + wanted.beyond;
    score[v] = x[wanted.end] < wanted.reach ? s : std::min(s, kOutside);
  }
  return score;
}

}  // namespace

Loop border_loop(const Skin& skin, const BodyCoordinates& coordinates, const BorderOfLimb& wanted, int side) {
  const float zero = 0.0F;
  const auto lines =
      geodesic::isolines(skin.mesh, skin.edges, scores(skin, coordinates, wanted, side), {&zero, 1})[0];
  const Isoline* best = nullptr;
  for (const Isoline& line : lines)
    if (best == nullptr || line.girth_m > best->girth_m) best = &line;
  if (best == nullptr) return {};
  Loop loop{best->centroid, skin.edges.ends[best->edges[0]][0], best->girth_m, best->closed ? 1.0 : 0.5};
  loop.level_m = mean_on(skin, *best, distances_from_end(coordinates.extremities(), wanted.end, side));
  loop.from_front = least_on(skin, *best, coordinates.from_front());
  loop.from_back = least_on(skin, *best, coordinates.from_back());
  return loop;
}

}  // namespace bodice::anatomy
