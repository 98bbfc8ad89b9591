#include "pack.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace bodice::inline v0_1::page {
namespace {

using geometry::Index;
using geometry::Vec3;

ThinMesh clustered(const geometry::TriMesh& mesh, double cell_m) {
  std::map<std::array<std::int64_t, 3>, Index> of_cell;
  std::vector<Index> thin_of(mesh.positions.size());
  ThinMesh thin;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    std::array<std::int64_t, 3> cell{};
    for (int k = 0; k < 3; ++k)
      cell[static_cast<std::size_t>(k)] =
          static_cast<std::int64_t>(std::floor(mesh.positions[v][k] / cell_m));
    const auto [at, is_new] = of_cell.try_emplace(cell, static_cast<Index>(thin.vertex.size()));
    if (is_new) thin.vertex.push_back(static_cast<Index>(v));
    thin_of[v] = at->second;
  }
  for (const geometry::Triangle& t : mesh.triangles) {
    const geometry::Triangle moved = {thin_of[t[0]], thin_of[t[1]], thin_of[t[2]]};
    if (moved[0] != moved[1] && moved[1] != moved[2] && moved[2] != moved[0]) thin.triangles.push_back(moved);
  }
  return thin;
}

}  // namespace

Cube cube_around(std::span<const Vec3> points, const Cube* with) {
  geometry::Box box = geometry::bounding_box(points);
  if (with) box.extend(with->low), box.extend(with->low + Vec3::Constant(with->size_m));
  if (box.empty()) return {};
  return {box.low, std::max(1e-6, box.size().maxCoeff())};
}

std::string packed_positions(std::span<const Vec3> points, const Cube& cube) {
  std::vector<std::uint16_t> values;
  values.reserve(3 * points.size());
  for (const Vec3& p : points)
    for (int k = 0; k < 3; ++k) {
      const double at = (p[k] - cube.low[k]) / cube.size_m;
      values.push_back(static_cast<std::uint16_t>(std::lround(65535.0 * std::clamp(at, 0.0, 1.0))));
    }
  return packed(values);
}

std::string packed_colors(std::span<const std::array<float, 3>> colors) {
  std::vector<std::uint8_t> values;
  values.reserve(3 * colors.size());
  for (const auto& color : colors)
    for (const float c : color) values.push_back(static_cast<std::uint8_t>(std::lround(255.0f * c)));
  return packed(values);
}

std::string packed_triangles(std::span<const geometry::Triangle> triangles) {
  return engine::base64(std::as_bytes(triangles));
}

ThinMesh thinned(const geometry::TriMesh& mesh, std::size_t most) {
  if (mesh.positions.size() <= most) {
    ThinMesh same;
    same.vertex.resize(mesh.positions.size());
    std::iota(same.vertex.begin(), same.vertex.end(), Index{0});
    same.triangles = mesh.triangles;
    return same;
  }
  double cell_m = std::sqrt(geometry::surface_area(mesh) / static_cast<double>(most));
  ThinMesh thin = clustered(mesh, cell_m);
  while (thin.vertex.size() > most && cell_m > 0.0) thin = clustered(mesh, cell_m *= 1.2);
  return thin;
}

}  // namespace bodice::page
