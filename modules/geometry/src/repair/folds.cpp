#include <bodice/geometry/folds.hpp>

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/mesh_edges.hpp>

#include "repair/rings.hpp"
#include "repair/smooth_normals.hpp"

namespace bodice::inline v0_1::geometry {
namespace {

/// Steps toward the middle of the neighbors, and the share of the distance that each goes.
constexpr int kSteps = 6;
constexpr double kStep = 0.5;
constexpr std::size_t kFoldGrain = 2048;

/// The mean cosine, either sign, between a vertex' normal and its triangles: .9 on fingers. Below it there is
/// a tip, which the middle of the neighbors would cut off.
constexpr double kTip = 0.4;

/// #V: vertices that stay, at rims, where more than two triangles meet, and at tips.
std::vector<char> find_fixed(const TriMesh& mesh, const std::vector<Vec3>& normals) {
  const MeshEdges edges = mesh_edges(mesh);
  std::vector<char> fixed(mesh.positions.size());
  for (std::size_t e = 0; e < edges.ends.size(); ++e)
    if (edges.triangle_count[e] != 2)
      for (const Index v : edges.ends[e]) fixed[v] = true;
  std::vector<double> along(fixed.size()), all(fixed.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 area = area_vector(mesh, t);
    for (const Index v : mesh.triangles[t]) along[v] += std::abs(area.dot(normals[v])), all[v] += area.norm();
  }
  for (std::size_t v = 0; v < fixed.size(); ++v) fixed[v] = fixed[v] || along[v] < kTip * all[v];
  return fixed;
}

/// Toward the middle of the neighbors, without what leads off the surface.
Vec3 step_along(const std::vector<Vec3>& positions, std::span<const Index> neighbors, const Vec3& from,
                const Vec3& normal) {
  Vec3 sum = Vec3::Zero();
  for (const Index other : neighbors) sum += positions[other];
  const Vec3 by = sum / static_cast<double>(neighbors.size()) - from;
  return kStep * (by - by.dot(normal) * normal);
}

}  // namespace

double folded_share(const TriMesh& mesh) {
  const std::vector<Vec3> normals = vertex_normals(mesh);
  std::vector<char> folded(mesh.positions.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 area = area_vector(mesh, t);
    for (const Index v : mesh.triangles[t])
      if (area.dot(normals[v]) < 0.0) folded[v] = true;
  }
  const auto count = std::ranges::count(folded, char{1});
  return folded.empty() ? 0.0 : static_cast<double>(count) / static_cast<double>(folded.size());
}

std::vector<Vec3> without_folds(const engine::Context& context, const TriMesh& mesh) {
  const Neighbors neighbors(mesh);
  const std::vector<Vec3> normals = smooth_normals(context, neighbors, vertex_normals(mesh));
  const std::vector<char> fixed = find_fixed(mesh, normals);
  std::vector<Vec3> positions = mesh.positions, next = positions;
  const auto for_each_free = [&](auto&& move) {
    engine::parallel_for(context, positions.size(), kFoldGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v)
        if (!fixed[v] && !neighbors.of(v).empty() && normals[v].squaredNorm() > 0.5) move(v);
    });
  };
  for (int pass = 0; pass < kSteps; ++pass) {
    for_each_free([&](std::size_t v) {
      next[v] = positions[v] + step_along(positions, neighbors.of(v), positions[v], normals[v]);
    });
    positions = next;
  }
  const MeshDistance surface(context, mesh);
  for_each_free([&](std::size_t v) { positions[v] = surface.closest_point(positions[v]).point; });
  return positions;
}

}  // namespace bodice::geometry
