// Based on: Alec Jacobson, Ladislav Kavan, Olga Sorkine-Hornung. Robust inside-outside segmentation using
// generalized winding numbers. 2013. Differs: the surface is contoured on a grid and moved onto the data.
#include <bodice/geometry/rebuild.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/contour.hpp>
#include <bodice/geometry/disjoint_sets.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/mesh_repair.hpp>
#include <bodice/geometry/triangle.hpp>

namespace bodice::inline v0_1::geometry {
namespace {

/// A vertex within so many cells of the data is measured.
constexpr double kMeasuredCells = 1.0;
/// Cosine between normal and offset above which a vertex lies above the data and not beside its rim.
constexpr double kAlongNormal = 0.9;
/// Components below this share of the largest one's area are bubbles and debris.
constexpr double kSmallest = 0.01;
/// The least volume of a component by its area to the power of 1.5: a finger has .03, and a ball .09.
constexpr double kLeastRoundness = 0.004;
/// Cells from the contour to data that is too thin for it, and from the finished surface to data that it has
/// lost; what lies farther than the last is something else.
constexpr double kThinFrom = 1.25, kLostFrom = 2.0, kLostUpTo = 12.0;
/// How much thicker lost parts become to either side, in cells: a contour keeps what is thicker than one.
constexpr double kThicker = 0.75;
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

/// Marks the triangles of the data with a corner that is farther than `from_m` from the surface. What is
/// farther than `up_to_m` in one piece with them is something else, such as a floor.
std::vector<char> find_lost(const engine::Context& context, const TriMesh& data, const MeshDistance& distance,
                            double from_m, double up_to_m) {
  std::vector<char> beside(data.positions.size()), far(data.positions.size());
  engine::parallel_for(context, beside.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      beside[v] = !distance.closest_point_within(data.positions[v], from_m);
      far[v] = beside[v] && !distance.closest_point_within(data.positions[v], up_to_m);
    }
  });
  DisjointSets pieces(data.positions.size());
  std::vector<char> lost(data.triangles.size());
  for (std::size_t t = 0; t < lost.size(); ++t) {
    const Triangle& corners = data.triangles[t];
    lost[t] = std::ranges::any_of(corners, [&](Index v) { return beside[v] != 0; });
    for (std::size_t k = 0; lost[t] && k < 2; ++k) pieces.unite(corners[k], corners[k + 1]);
  }
  std::vector<char> is_else(data.positions.size());
  for (Index v = 0; v < far.size(); ++v)
    if (far[v]) is_else[pieces.find(v)] = true;
  for (std::size_t t = 0; t < lost.size(); ++t)
    if (lost[t] && is_else[pieces.find(data.triangles[t][0])]) lost[t] = false;
  return lost;
}

/// Unmarks triangles inside of the surface: ends of pieces that are tucked into others are covered.
void keep_outside(const TriMesh& data, const MeshDistance& surface, std::vector<char>& lost) {
  for (std::size_t t = 0; t < lost.size(); ++t)
    if (lost[t]) lost[t] = !surface.inside((data.corner(t, 0) + data.corner(t, 1) + data.corner(t, 2)) / 3.0);
}

double share_of(const std::vector<char>& chosen, const TriMesh& mesh) {
  double all = 0.0, sum = 0.0;
  for (std::size_t t = 0; t < chosen.size(); ++t) {
    const double area = area_vector(mesh, t).norm();
    all += area;
    sum += chosen[t] ? area : 0.0;
  }
  return all > 0.0 ? sum / all : 0.0;
}

/// Puts the nodes around a triangle inside.
void thicken(const TriMesh& data, std::size_t t, FieldGrid& grid) {
  const double reach_m = kThicker * grid.cell_m;
  Box box;
  for (int k = 0; k < 3; ++k) box.extend(data.corner(t, k));
  std::array<std::size_t, 3> first, last;
  for (int axis = 0; axis < 3; ++axis) {
    const auto node = [&](double at) {
      const double most = static_cast<double>(grid.nodes[static_cast<std::size_t>(axis)] - 1);
      return static_cast<std::size_t>(std::clamp((at - grid.low[axis]) / grid.cell_m, 0.0, most));
    };
    const auto k = static_cast<std::size_t>(axis);
    first[k] = node(box.low[axis] - reach_m), last[k] = node(box.high[axis] + reach_m + grid.cell_m);
  }
  for (std::size_t z = first[2]; z <= last[2]; ++z)
    for (std::size_t y = first[1]; y <= last[1]; ++y)
      for (std::size_t x = first[0]; x <= last[0]; ++x) {
        const Vec3 at = grid.low + grid.cell_m * Vec3(static_cast<double>(x), static_cast<double>(y),
                                                      static_cast<double>(z));
        const Vec3 on = closest_point(data.corner(t, 0), data.corner(t, 1), data.corner(t, 2), at).point;
        float& value = grid.value[grid.index(x, y, z)];
        value = std::min(value, static_cast<float>((on - at).norm() - reach_m));
      }
}

/// The contour of the grid, in which parts that are thinner than a cell, such as fingers, are kept: what a
/// first contour loses is made thicker. Its vertices are moved onto the data later, as all others.
TriMesh contour_with_thin_parts(const engine::Context& context, const TriMesh& data, FieldGrid& grid) {
  TriMesh out = without_small_components(contour(context, grid));
  if (out.empty()) return out;
  const std::vector<char> lost =
      find_lost(context, data, MeshDistance(context, out), kThinFrom * grid.cell_m, kLostUpTo * grid.cell_m);
  if (std::ranges::count(lost, char{1}) == 0) return out;
  for (std::size_t t = 0; t < lost.size(); ++t)
    if (lost[t]) thicken(data, t, grid);
  close_border(grid);
  return without_small_components(contour(context, grid));
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

/// Removes components that lie flat on the data: the winding number may be above one half between the two
/// sides of a floor. The largest component stays.
void drop_flat_components(RebuiltSurface& out) {
  const Components components = connected_components(out.mesh);
  std::vector<double> volume(components.area.size());
  for (const Triangle& t : out.mesh.triangles) {
    const auto& p = out.mesh.positions;
    volume[components.of_vertex[t[0]]] += p[t[0]].dot(p[t[1]].cross(p[t[2]])) / 6.0;
  }
  std::vector<char> flat(volume.size());
  for (std::size_t c = 1; c < flat.size(); ++c)
    flat[c] = std::abs(volume[c]) < kLeastRoundness * std::pow(components.area[c], 1.5);
  if (std::ranges::count(flat, char{1}) == 0) return;
  std::vector<Index> moved_to(out.mesh.positions.size());
  Index count = 0;
  for (std::size_t v = 0; v < moved_to.size(); ++v) {
    moved_to[v] = count;
    if (flat[components.of_vertex[v]]) continue;
    out.mesh.positions[count] = out.mesh.positions[v];
    out.measured[count++] = out.measured[v];
  }
  std::erase_if(out.mesh.triangles, [&](const Triangle& t) { return flat[components.of_vertex[t[0]]] != 0; });
  for (Triangle& t : out.mesh.triangles)
    for (Index& v : t) v = moved_to[v];
  out.mesh.positions.resize(count);
  out.measured.resize(count);
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
  out.mesh = contour_with_thin_parts(context, surface, grid);
  if (out.mesh.empty()) return out;
  snap(context, data, kMeasuredCells * cell_m, out);
  drop_flat_components(out);
  smooth_made_up(out);
  out.measured_share = measured_share(out);
  const MeshDistance rebuilt(context, out.mesh);
  std::vector<char> lost = find_lost(context, surface, rebuilt, kLostFrom * cell_m, kLostUpTo * cell_m);
  keep_outside(surface, rebuilt, lost);
  out.lost_share = share_of(lost, surface);
  return out;
}

}  // namespace bodice::geometry
