#include <bodice/anatomy/thing.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <bodice/engine/catch_canceled.hpp>
#include <bodice/engine/stage_timer.hpp>
#include <bodice/geodesic/distance.hpp>
#include <bodice/geometry/mesh_repair.hpp>

namespace bodice::inline v0_1::anatomy {
namespace {

using geometry::Index;
using geometry::kNoIndex;
using geometry::TriMesh;
using geometry::Vec3;

/// Squared stature over area of a person: 1.70 m and 1.75 m2.
constexpr double kStatureByArea = 1.65;
/// Volume over area to the power 1.5. It is .094 for a sphere and 2e-3 for a board of 1 m by 1 m by 5 mm.
constexpr double kLeastVolume = 1e-4;
/// A loose piece with less of the area is no part of its own.
constexpr double kLeastPiece = 0.01;
/// A point farther than this from all centers becomes one, a fraction of the square root of the area: the
/// legs of chairs and dogs and the fingers of a hand are.
constexpr double kWide = 0.4;
/// Rounds after which centers of real things have come to rest, or move by a vertex or two.
constexpr int kRounds = 10;

/// What the clusters are made of.
struct Surface {
  const TriMesh& mesh;
  geodesic::EdgeGraph graph;
  geometry::Components pieces;
  std::vector<double> area;  ///< #V: a third of the triangles at each vertex
  double whole = 0.0;        ///< the sum of these
};

Surface make_surface(const engine::Context& context, const TriMesh& mesh) {
  Surface surface{
      mesh, geodesic::edge_graph(context, mesh, geometry::mesh_edges(mesh), geodesic::Metric::kUnfolded),
      geometry::connected_components(mesh), std::vector<double>(mesh.positions.size(), 0.0)};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const Index v : mesh.triangles[t]) surface.area[v] += area_vector(mesh, t).norm() / 6.0;
  surface.whole = std::accumulate(surface.area.begin(), surface.area.end(), 0.0);
  return surface;
}

/// Groups of vertices; a vertex of group kNoIndex is in none.
struct Groups {
  std::vector<Index> of_vertex;
  std::vector<Vec3> centroid;
  std::vector<double> area;
};

Groups measured(const Surface& surface, std::vector<Index> of_vertex, std::size_t count) {
  Groups groups{std::move(of_vertex), std::vector<Vec3>(count, Vec3::Zero()), std::vector<double>(count)};
  for (std::size_t v = 0; v < surface.area.size(); ++v) {
    const Index g = groups.of_vertex[v];
    if (g >= count) continue;
    groups.centroid[g] += surface.area[v] * surface.mesh.positions[v];
    groups.area[g] += surface.area[v];
  }
  for (std::size_t g = 0; g < count; ++g)
    if (groups.area[g] > 0.0) groups.centroid[g] /= groups.area[g];
  return groups;
}

/// The vertex of each group that is nearest to its centroid.
std::vector<Index> centers_of(const Surface& surface, const Groups& groups) {
  std::vector<Index> centers(groups.centroid.size(), kNoIndex);
  std::vector<double> least(centers.size(), std::numeric_limits<double>::infinity());
  for (std::size_t v = 0; v < groups.of_vertex.size(); ++v) {
    const Index g = groups.of_vertex[v];
    if (g >= centers.size()) continue;
    const double squared = (surface.mesh.positions[v] - groups.centroid[g]).squaredNorm();
    if (squared < least[g]) least[g] = squared, centers[g] = static_cast<Index>(v);
  }
  return centers;
}

/// A center for each piece that is large enough, and for each point that is far from all others.
std::vector<Index> first_centers(const engine::Context& context, const Surface& surface) {
  const auto large = std::ranges::count_if(surface.pieces.area,
                                           [&](double area) { return area >= kLeastPiece * surface.whole; });
  const auto count = std::clamp<std::size_t>(static_cast<std::size_t>(large), 1, body::kThingPartCount);
  std::vector<Index> centers = centers_of(surface, measured(surface, surface.pieces.of_vertex, count));
  const double wide_m = kWide * std::sqrt(surface.whole);
  while (centers.size() < body::kThingPartCount) {
    context.cancel.check();
    const geodesic::Field field = geodesic::nearest_sources(surface.graph, centers).distance;
    Index farthest = kNoIndex;
    for (Index v = 0; v < field.size(); ++v)
      if (std::isfinite(field[v]) && (farthest == kNoIndex || field[v] > field[farthest])) farthest = v;
    if (farthest == kNoIndex || static_cast<double>(field[farthest]) < wide_m) break;
    centers.push_back(farthest);
  }
  return centers;
}

/// Lloyd's rounds along the surface.
Groups cluster(const engine::Context& context, const Surface& surface) {
  std::vector<Index> centers = first_centers(context, surface);
  Groups groups;
  for (int round = 0; round < kRounds; ++round) {
    context.cancel.check();
    groups = measured(surface, geodesic::nearest_sources(surface.graph, centers).source, centers.size());
    std::vector<Index> next = centers_of(surface, groups);
    if (next == centers) break;
    centers = std::move(next);
  }
  return groups;
}

/// Gives each piece that no center is on to the group with the nearest centroid.
void add_small_pieces(const Surface& surface, Groups& groups) {
  const Groups pieces = measured(surface, surface.pieces.of_vertex, surface.pieces.area.size());
  std::vector<Index> group_of(pieces.centroid.size(), kNoIndex);
  for (std::size_t v = 0; v < groups.of_vertex.size(); ++v) {
    Index& group = groups.of_vertex[v];
    if (group < groups.centroid.size()) continue;
    Index& of_piece = group_of[surface.pieces.of_vertex[v]];
    if (of_piece == kNoIndex) {
      const Vec3& at = pieces.centroid[surface.pieces.of_vertex[v]];
      const auto nearest = std::ranges::min_element(
          groups.centroid, {}, [&](const Vec3& centroid) { return (centroid - at).squaredNorm(); });
      of_piece = static_cast<Index>(nearest - groups.centroid.begin());
    }
    group = of_piece;
  }
}

std::vector<body::Part> parts_by_area(const Groups& groups) {
  std::vector<std::size_t> order(groups.area.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t g) { return groups.area[g]; });
  std::vector<body::Part> part_of(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) part_of[order[i]] = body::thing_part(static_cast<int>(i));
  std::vector<body::Part> part;
  part.reserve(groups.of_vertex.size());
  for (const Index group : groups.of_vertex) part.push_back(part_of[group]);
  return part;
}

/// The volume around the middle, so that a sheet encloses nothing wherever it lies.
double enclosed_volume(TriMesh mesh) {
  const Vec3 middle = geometry::bounding_box(mesh.positions).center();
  for (Vec3& p : mesh.positions) p -= middle;
  return std::abs(geometry::signed_volume(mesh));
}

engine::Result<Anatomy> analyze_checked(const engine::Context& context, const TriMesh& skin) {
  Anatomy anatomy;
  engine::StageTimer timer(context, anatomy.stages, "segment");
  const double area = geometry::surface_area(skin);
  if (!(enclosed_volume(skin) > kLeastVolume * std::pow(area, 1.5)))
    return engine::Error{engine::ErrorCode::kUnusableGeometry,
                         "The surface encloses nothing: it is a sheet, and a proxy is a solid.",
                         "Give it a thickness, for instance with a solidify modifier."};
  anatomy.stature_m = std::sqrt(kStatureByArea * area);
  const Surface surface = make_surface(context, skin);
  Groups groups = cluster(context, surface);
  add_small_pieces(surface, groups);
  anatomy.part = parts_by_area(measured(surface, std::move(groups.of_vertex), groups.area.size()));
  const Vec3 middle = geometry::bounding_box(skin.positions).center();
  for (int id = 0; id < body::kLandmarkCount; ++id)
    anatomy.landmarks.push_back({.id = static_cast<body::LandmarkId>(id), .position = middle});
  timer.stop();
  return anatomy;
}

}  // namespace

engine::Result<Anatomy> analyze_thing(const engine::Context& context, const TriMesh& skin) {
  return engine::catch_canceled("The analysis", [&] { return analyze_checked(context, skin); });
}

}  // namespace bodice::anatomy
