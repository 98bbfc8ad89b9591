// Based on: Alec Jacobson, Ladislav Kavan, Olga Sorkine-Hornung. Robust inside-outside segmentation using
// generalized winding numbers. 2013. Differs: the surface is contoured on a grid and moved onto the data.
#include <bodice/geometry/rebuild.hpp>

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/contour.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/mesh_repair.hpp>

namespace bodice::inline v0_1::geometry {
namespace {

/// A vertex within so many cells of the data is measured.
constexpr double kMeasuredCells = 1.0;
/// Cosine between normal and offset above which a vertex lies above the data and not beside its rim.
constexpr double kAlongNormal = 0.9;
/// Components below this share of the largest one's area are bubbles and debris.
constexpr double kSmallest = 0.01;
/// Passes that even out what closes a hole, and the share of each step.
constexpr int kSmoothings = 20;
constexpr double kSmoothing = 0.5;

TriMesh without_small_components(const TriMesh& mesh) {
  const Components components = connected_components(mesh);
  const auto& area = components.area;
  const auto kept =
      std::count_if(area.begin(), area.end(), [&](double one) { return !(one < kSmallest * area.front()); });
  return largest_components(mesh, components, static_cast<std::size_t>(kept));
}

/// Moves vertices onto the data where it is near, along its normal: at a rim they would all meet in one line.
void snap(const engine::Context& context, const MeshDistance& data, double within_m, RebuiltSurface& out) {
  std::vector<char> near(out.mesh.positions.size());
  engine::parallel_for(context, near.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const auto hit = data.closest_point_within(out.mesh.positions[v], within_m);
      if (!hit) continue;
      const Vec3 offset = hit->point - out.mesh.positions[v];
      if (std::abs(offset.dot(hit->normal)) < kAlongNormal * offset.norm()) continue;
      near[v] = true;
      out.mesh.positions[v] = hit->point;
    }
  });
  out.measured.assign(near.begin(), near.end());
}

/// Each vertex that is not measured goes toward the mean of its neighbors: the steps of the grid vanish.
void smooth_made_up(RebuiltSurface& out) {
  std::vector<Vec3>& positions = out.mesh.positions;
  std::vector<Vec3> sum(positions.size());
  std::vector<int> count(positions.size());
  for (int pass = 0; pass < kSmoothings; ++pass) {
    std::fill(sum.begin(), sum.end(), Vec3(Vec3::Zero()));
    std::fill(count.begin(), count.end(), 0);
    for (const Triangle& t : out.mesh.triangles)
      for (int k = 0; k < 3; ++k) {
        if (out.measured[t[k]]) continue;
        sum[t[k]] += positions[t[(k + 1) % 3]] + positions[t[(k + 2) % 3]];
        count[t[k]] += 2;
      }
    for (std::size_t v = 0; v < positions.size(); ++v)
      if (count[v] > 0) positions[v] += kSmoothing * (sum[v] / count[v] - positions[v]);
  }
}

/// Puts the border of the grid outside. Sheets that lie on each other wind around a region that reaches
/// beyond them all, and a contour that runs into the border is open.
void close_border(FieldGrid& grid) {
  const auto [nx, ny, nz] = grid.nodes;
  const auto put_outside = [&](std::size_t x, std::size_t y, std::size_t z) {
    float& value = grid.value[grid.index(x, y, z)];
    if (!(value > 0.0f)) value = static_cast<float>(grid.cell_m);
  };
  for (std::size_t z = 0; z < nz; ++z)
    for (std::size_t y = 0; y < ny; ++y) {
      const bool face = z == 0 || y == 0 || z + 1 == nz || y + 1 == ny;
      for (std::size_t x = 0; x < nx; x += face || nx < 2 ? 1 : nx - 1) put_outside(x, y, z);
    }
}

double measured_share(const RebuiltSurface& surface) {
  double all = 0.0, measured = 0.0;
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    const double area = area_vector(surface.mesh, t).norm();
    all += area;
    for (const Index v : surface.mesh.triangles[t]) measured += surface.measured[v] ? area / 3.0 : 0.0;
  }
  return all > 0.0 ? measured / all : 0.0;
}

}  // namespace

RebuiltSurface rebuild(const engine::Context& context, const TriMesh& surface, double cell_m) {
  const MeshDistance data(context, surface);
  RebuiltSurface out;
  FieldGrid grid = sample_inside(context, data, bounding_box(surface.positions), cell_m);
  close_border(grid);
  const TriMesh all = contour(context, grid);
  if (all.empty()) return out;
  out.mesh = without_small_components(all);
  snap(context, data, kMeasuredCells * cell_m, out);
  smooth_made_up(out);
  out.measured_share = measured_share(out);
  return out;
}

}  // namespace bodice::geometry
