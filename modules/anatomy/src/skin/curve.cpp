#include "skin/curve.hpp"

namespace bodice::inline v0_1::anatomy {

using geometry::Vec3;

double turning(const Skin& skin, const geodesic::Isoline& loop, std::span<const float> rising) {
  double sum = 0.0;
  const std::size_t n = loop.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto [a, b] = skin.edges.ends[loop.edges[i]];
    Vec3 up = skin.mesh.positions[b] - skin.mesh.positions[a];
    if (rising[b] < rising[a]) up = -up;
    const Vec3 tangent = loop.points[(i + 1) % n] - loop.points[(i + n - 1) % n];
    sum +=
        tangent.dot(up.cross(normal_at_edge(skin, loop.edges[i]))) > 0.0 ? tangent.norm() : -tangent.norm();
  }
  return sum >= 0.0 ? 1.0 : -1.0;
}

float value_at(const Skin& skin, const geodesic::Isoline& loop, std::size_t point,
               std::span<const float> field) {
  return value_at(skin, SkinPoint{loop.edges[point], loop.points[point]}, field);
}

const geodesic::Isoline* widest_closed(const std::vector<geodesic::Isoline>& lines) {
  const geodesic::Isoline* best = nullptr;
  for (const geodesic::Isoline& line : lines)
    if (line.closed && (best == nullptr || line.girth_m > best->girth_m)) best = &line;
  return best;
}

}  // namespace bodice::anatomy
