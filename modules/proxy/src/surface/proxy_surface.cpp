#include <bodice/proxy/proxy_surface.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include <bodice/engine/catch_canceled.hpp>
#include <bodice/engine/message.hpp>
#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/split_pinches.hpp>
#include <bodice/proxy/proxy_distance.hpp>

#include "surface/crossed_cells.hpp"

namespace bodice::inline v0_1::proxy {
namespace {

using geometry::Index;

constexpr std::size_t kGrain = 64;    // distances a block; each takes some microseconds
constexpr int kSteps = 2;             // steps down the gradient
constexpr double kSettled = 1e-3;     // distance to the surface at which a vertex is done, in cells
constexpr double kLongestMove = 0.5;  // of a vertex, in cells, so that the vertices of a cell stay near it
constexpr double kPinchShare = 0.02;  // of an edge, by which sheets that touch are set apart
constexpr int kSeedsPerSide = 9;      // seeds an ellipsoid, along each side of the octahedral map

/// Points on or near the surface of each ellipsoid, from which the search for crossed cells starts.
std::vector<Vec3> seeds_of(const engine::Context& context, const BodyProxy& proxy) {
  constexpr std::size_t kEach = kSeedsPerSide * kSeedsPerSide;
  std::vector<Vec3> seeds(proxy.ellipsoids().size() * kEach);
  engine::parallel_for(context, seeds.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const geometry::Ellipsoid& e = proxy.ellipsoids()[i / kEach].shape;
      const auto at = static_cast<int>(i % kEach);
      const auto coordinate = [](int k) { return 2.0 * k / (kSeedsPerSide - 1) - 1.0; };
      const Vec3 w = octahedral_direction(coordinate(at % kSeedsPerSide), coordinate(at / kSeedsPerSide));
      Vec3& p = seeds[i] = e.center + e.axes * e.radii.cwiseProduct(w);
      for (int step = 0; step < kSteps; ++step) {
        const ProxyDistance there = proxy_distance(proxy, p);
        p -= there.distance * there.normal;
      }
    }
  });
  return seeds;
}

/// The mean of the points where the surface crosses the cell's edges.
Vec3 middle_of_crossings(const CrossedCells& cells, const Cell& cell) {
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (int corner = 0; corner < 8; ++corner) {
      if (corner & (1 << axis)) continue;
      const double a = cells.value(cell, corner), b = cells.value(cell, corner | (1 << axis));
      if ((a < 0.0) == (b < 0.0)) continue;
      const Vec3 from = cells.position(cell.at, corner), to = cells.position(cell.at, corner | (1 << axis));
      sum += from + a / (a - b) * (to - from);
      ++count;
    }
  return sum / count;
}

/// Sets one vertex a cell, moved from the middle of its crossings to the surface by a few steps down the
/// gradient.
void place_vertices(const engine::Context& context, const BodyProxy& proxy, const CrossedCells& cells,
                    double cell_m, ProxySurface& surface) {
  const std::size_t count = cells.cells().size();
  surface.mesh.positions.resize(count), surface.normals.resize(count), surface.owner.resize(count);
  engine::parallel_for(context, count, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 start = middle_of_crossings(cells, cells.cells()[i]);
      Vec3 p = start;
      ProxyDistance at = proxy_distance(proxy, p);
      for (int step = 0; step < kSteps && std::abs(at.distance) > kSettled * cell_m; ++step) {
        const Vec3 next = p - at.distance * at.normal;
        if (!((next - start).norm() <= kLongestMove * cell_m)) break;
        p = next, at = proxy_distance(proxy, p);
      }
      surface.mesh.positions[i] = p, surface.normals[i] = at.normal, surface.owner[i] = at.owner;
    }
  });
}

/// Adds two triangles for each lattice edge that the surface crosses, through the four cells around it. Each
/// cell contributes the edges at its first corner.
void span_faces(const CrossedCells& cells, geometry::TriMesh& mesh) {
  for (const Cell& cell : cells.cells())
    for (int axis = 0; axis < 3; ++axis) {
      const bool leaves = cells.value(cell, 0) < 0.0;  // the surface's inside comes first along the axis
      if (leaves == (cells.value(cell, 1 << axis) < 0.0)) continue;
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const auto beside = [&](int du, int dv) {
        LatticePoint p = cell.at;
        p[static_cast<std::size_t>(u)] -= du, p[static_cast<std::size_t>(v)] -= dv;
        return cells.index_of(p);
      };
      std::array<Index, 4> ring = {beside(0, 0), beside(1, 0), beside(1, 1), beside(0, 1)};
      if (!leaves) std::swap(ring[1], ring[3]);
      const auto span = [&](int a, int b) {
        return (mesh.positions[ring[static_cast<std::size_t>(a)]] -
                mesh.positions[ring[static_cast<std::size_t>(b)]])
            .squaredNorm();
      };
      if (span(0, 2) <= span(1, 3)) {
        mesh.triangles.push_back({ring[0], ring[1], ring[2]});
        mesh.triangles.push_back({ring[0], ring[2], ring[3]});
      } else {
        mesh.triangles.push_back({ring[1], ring[2], ring[3]});
        mesh.triangles.push_back({ring[1], ring[3], ring[0]});
      }
    }
}

/// Sheets that pass through one cell have had one vertex there.
void separate_sheets(ProxySurface& surface) {
  for (const Index vertex : geometry::split_pinches(surface.mesh, kPinchShare)) {
    surface.normals.push_back(Vec3(surface.normals[vertex]));
    surface.owner.push_back(std::uint32_t{surface.owner[vertex]});
  }
}

engine::Error unusable_cell(double cell_m) {
  return {engine::ErrorCode::kInvalidArgument,
          engine::message("A surface in cells of ", cell_m, " m cannot be made of this proxy."),
          "Give a positive cell; a three-hundredth of the stature is usual."};
}

engine::Result<ProxySurface> surface_of(const engine::Context& context, const BodyProxy& proxy,
                                        double cell_m) {
  geometry::Box box;
  for (const ProxyEllipsoid& e : proxy.ellipsoids()) {
    const geometry::Box own = geometry::bounding_box(e.shape);
    box.extend(own.low), box.extend(own.high);
  }
  ProxySurface surface;
  if (proxy.ellipsoids().empty()) return surface;
  const double widest_m = box.size().maxCoeff() + 2.0 * std::abs(proxy.margin_m()) + proxy.stature_m();
  if (!(cell_m > 0.0) || !(widest_m / cell_m < CrossedCells::kMostCellsAcross)) return unusable_cell(cell_m);
  CrossedCells cells(box.center(), cell_m);
  const auto distance = [&](const Vec3& p) { return proxy_distance(proxy, p).distance; };
  if (!cells.find(context, seeds_of(context, proxy), distance)) return unusable_cell(cell_m);
  place_vertices(context, proxy, cells, cell_m, surface);
  span_faces(cells, surface.mesh);
  separate_sheets(surface);
  return surface;
}

}  // namespace

engine::Result<ProxySurface> proxy_surface(const engine::Context& context, const BodyProxy& proxy,
                                           double cell_m) {
  return engine::catch_canceled("The proxy's surface", [&] { return surface_of(context, proxy, cell_m); });
}

}  // namespace bodice::proxy
