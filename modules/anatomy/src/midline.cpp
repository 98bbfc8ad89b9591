#include "midline.hpp"

#include <cmath>

#include "curve.hpp"

namespace bodice::anatomy {
namespace {

using geodesic::Field;
using geodesic::Isoline;
using geometry::Index;

Field difference(const Field& a, const Field& b) {
  Field d(a.size());
  for (std::size_t v = 0; v < a.size(); ++v) d[v] = a[v] - b[v];
  return d;
}

std::vector<Isoline> zero_lines(const Skin& skin, const Field& field) {
  const float zero = 0.0F;
  return geodesic::isolines(skin.mesh, skin.edges, field, {&zero, 1})[0];
}

SkinPoint point_of(const Isoline& loop, std::size_t i) {
  return {loop.edges[i], loop.points[i]};
}

/// The point least far from the hands among those between positions `from` and `to` of the loop, cyclically.
SkinPoint nearest_to_hands(const Skin& skin, const BodyEnds& ends, const Isoline& loop, std::size_t from,
                           std::size_t to) {
  SkinPoint best;
  float least = 0.0F;
  const std::size_t n = loop.points.size();
  for (std::size_t i = from; i != to; i = (i + 1) % n) {
    const float d = value_at(skin, loop, i, *ends.from_hand[0]) + value_at(skin, loop, i, *ends.from_hand[1]);
    if (best.found() && d >= least) continue;
    best = point_of(loop, i);
    least = d;
  }
  return best;
}

/// Crown and crotch cut the middle line in two: counter-clockwise seen from the left, the front comes first.
void find_front_and_back(const Skin& skin, const BodyEnds& ends, Midline& middle) {
  const Field leftward = difference(*ends.from_hand[1], *ends.from_hand[0]);
  const auto lines = zero_lines(skin, leftward);
  const Isoline* loop = widest_closed(lines);
  if (loop == nullptr) return;
  std::size_t top = 0, bottom = 0;
  for (std::size_t i = 0; i < loop->points.size(); ++i) {
    const float head = value_at(skin, *loop, i, *ends.from_head);
    if (head < value_at(skin, *loop, top, *ends.from_head)) top = i;
    if (head > value_at(skin, *loop, bottom, *ends.from_head)) bottom = i;
  }
  middle.front = nearest_to_hands(skin, ends, *loop, top, bottom);
  middle.back = nearest_to_hands(skin, ends, *loop, bottom, top);
  if (turning(skin, *loop, leftward) < 0.0) std::swap(middle.front, middle.back);
}

/// The crotch is where the line between the legs is hardly further from the feet than the way from foot to
/// foot goes.
constexpr float kNearCrossing = 1.12F;

SkinPoint find_perineum(const Skin& skin, const BodyEnds& ends) {
  SkinPoint best;
  float most = -1.0F;
  const float reach = 0.5F * kNearCrossing * ends.feet_apart;
  for (const Isoline& line : zero_lines(skin, difference(*ends.from_foot[0], *ends.from_foot[1])))
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const float head = value_at(skin, line, i, *ends.from_head);
      if (head <= most || value_at(skin, line, i, *ends.from_foot[0]) > reach) continue;
      most = head;
      best = point_of(line, i);
    }
  return best;
}

}  // namespace

Midline find_midline(const Skin& skin, const BodyEnds& ends) {
  Midline middle;
  find_front_and_back(skin, ends, middle);
  middle.perineum = find_perineum(skin, ends);
  return middle;
}

Field distances_from(const Skin& skin, const SkinPoint& point) {
  std::array<geodesic::Seed, 2> seeds{};
  for (int k = 0; k < 2; ++k) {
    seeds[k].vertex = skin.edges.ends[point.edge][k];
    seeds[k].distance = static_cast<float>((skin.mesh.positions[seeds[k].vertex] - point.position).norm());
  }
  return geodesic::distances(skin.graph, seeds);
}

Index nearest_vertex(const Skin& skin, const SkinPoint& point) {
  const auto [a, b] = skin.edges.ends[point.edge];
  const double to_a = (skin.mesh.positions[a] - point.position).squaredNorm();
  return to_a <= (skin.mesh.positions[b] - point.position).squaredNorm() ? a : b;
}

}  // namespace bodice::anatomy
