#include "coordinates/midline.hpp"

#include <cmath>

#include "skin/curve.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using geodesic::Field;
using geodesic::Isoline;
using geometry::Index;
using geometry::Vec3;

Field difference(const Field& a, const Field& b) {
  Field d(a.size());
  for (std::size_t v = 0; v < a.size(); ++v) d[v] = a[v] - b[v];
  return d;
}

std::vector<Isoline> zero_lines(const Skin& skin, const Field& field) {
  const float zero = 0.0F;
  return geodesic::isolines(skin.mesh, skin.edges, field, {&zero, 1})[0];
}

SkinPoint point_of(const Isoline& line, std::size_t i) {
  return {line.edges[i], line.points[i]};
}

/// Direction in which the field grows on a triangle, up to a positive factor.
Vec3 rising(const Skin& skin, Index triangle, const Field& field) {
  const auto& t = skin.mesh.triangles[triangle];
  const Vec3 normal = geometry::area_vector(skin.mesh, triangle);
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vec3 facing = skin.mesh.corner(triangle, (k + 2) % 3) - skin.mesh.corner(triangle, (k + 1) % 3);
    sum += static_cast<double>(field[t[k]]) * normal.cross(facing);
  }
  return sum;
}

/// On the midline left and up are known from the fields, so that the outward normal distinguishes the chest,
/// where left = up x outward, from the back, where left = outward x up.
bool faces_front(const Skin& skin, const BodyExtremities& tips, const Field& leftward, Index edge) {
  const Index triangle = skin.edges.triangles[edge][0];
  const Vec3 up = -rising(skin, triangle, *tips.from_head);
  return rising(skin, triangle, leftward).dot(up.cross(geometry::area_vector(skin.mesh, triangle))) > 0.0;
}

/// The points of the midline on chest and back that are nearest to the hands.
void find_front_and_back(const Skin& skin, const BodyExtremities& tips, Midline& middle) {
  const Field leftward = difference(*tips.from_hand[1], *tips.from_hand[0]);
  float least_front = 0.0F, least_back = 0.0F;
  for (const Isoline& line : zero_lines(skin, leftward))
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const bool front = faces_front(skin, tips, leftward, line.edges[i]);
      const float hands = value_at(skin, line, i, *tips.from_hand[0]);
      float& least = front ? least_front : least_back;
      SkinPoint& best = front ? middle.front : middle.back;
      if (best.found() && hands >= least) continue;
      best = point_of(line, i);
      least = hands;
    }
}

}  // namespace

Midline find_midline(const Skin& skin, const BodyExtremities& tips) {
  Midline middle;
  find_front_and_back(skin, tips, middle);
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

}  // namespace bodice::anatomy
