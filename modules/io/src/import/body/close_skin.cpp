#include "import/body/close_skin.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/mesh_edges.hpp>
#include <bodice/geometry/rebuild.hpp>

namespace bodice::inline v0_1::io {

namespace {

using geometry::Index;
using geometry::kNoIndex;
using geometry::RepairedMesh;
using geometry::TriMesh;
using geometry::Vec3;

/// Length of the rims over the square root of the area. It is up to .3 for skins with open eyes and
/// mouth, 1.5 with some lost vertices, and 4 and more for scans.
constexpr double kNearlyClosed = 2.0;
/// A surface of fewer triangles shows no person, and a rebuilt one would have a hundred thousand.
constexpr std::size_t kFewestTriangles = 100;
/// Cells of a rebuilt skin along the body's longest side: 8 mm for a person that stands.
constexpr double kCells = 215.0;
/// Nodes of the grid: bodies have 2 million in a T pose; what would need more is no body, and gets larger
/// cells.
constexpr double kMostNodes = 3e6;
/// Area to squared diagonal above which a surface is no body: that of a crouching one is .8, of a
/// sphere 1.05.
constexpr double kTooCompact = 1.0;
/// The winding of the file is kept as long as it encloses this share of what turned triangles enclose.
constexpr double kWellWound = 0.6;
/// A rebuilt skin with less of its area on the data is made up.
constexpr double kLeastMeasured = 0.5;

/// A closed skin of which more, in percent, is made up is in doubt.
constexpr long kMuchMadeUp = 10;

/// A closed skin that lost more than this share of the file's area lacks some toes or a finger. Scans that
/// keep them lose up to .0006.
constexpr double kMuchLost = 0.0015;

double openness(const RepairedMesh& repaired) {
  if (repaired.report.boundary_edges == 0) return 0.0;
  const TriMesh& mesh = repaired.mesh;
  const geometry::MeshEdges edges = geometry::mesh_edges(mesh);
  double length = 0.0;
  for (Index e = 0; e < edges.ends.size(); ++e)
    if (edges.triangle_count[e] == 1)
      length += (mesh.positions[edges.ends[e][0]] - mesh.positions[edges.ends[e][1]]).norm();
  const double area = surface_area(mesh);
  return area > 0.0 ? length / std::sqrt(area) : 0.0;
}

/// The volume around the middle of the box, so that open surfaces count for what they enclose.
double enclosed(TriMesh mesh) {
  const Vec3 center = geometry::bounding_box(mesh.positions).center();
  for (Vec3& p : mesh.positions) p -= center;
  return signed_volume(mesh);
}

/// The surface wound outward: a scan's own winding, which holds for each patch, rather than one that is found
/// for each of them.
TriMesh outward(const TriMesh& input, const RepairedMesh& repaired) {
  TriMesh as_given = repaired.mesh;
  for (std::size_t t = 0; t < input.triangles.size(); ++t) {
    const Index kept = repaired.triangle_of_input[t];
    if (kept == kNoIndex) continue;
    for (std::size_t k = 0; k < 3; ++k)
      as_given.triangles[kept][k] = repaired.vertex_of_input[input.triangles[t][k]];
  }
  const double given = enclosed(as_given), turned = std::abs(enclosed(repaired.mesh));
  if (std::abs(given) < kWellWound * turned) return repaired.mesh;
  if (given < 0.0)
    for (geometry::Triangle& t : as_given.triangles) std::swap(t[1], t[2]);
  return as_given;
}

/// The nearest vertex of the new skin for each input vertex that is used.
std::vector<Index> map_vertices(const engine::Context& context, const TriMesh& input,
                                const RepairedMesh& repaired, const TriMesh& skin) {
  const geometry::MeshDistance distance(context, skin);
  std::vector<Index> map(input.positions.size(), kNoIndex);
  engine::parallel_for(context, map.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (repaired.vertex_of_input[v] == kNoIndex) continue;
      const geometry::SurfacePoint at = distance.closest_point(input.positions[v]);
      if (at.triangle == kNoIndex) continue;
      const geometry::Triangle& corners = skin.triangles[at.triangle];
      map[v] = *std::min_element(corners.begin(), corners.end(), [&](Index a, Index b) {
        return (skin.positions[a] - at.point).squaredNorm() < (skin.positions[b] - at.point).squaredNorm();
      });
    }
  });
  return map;
}

/// #V of the closed skin: whether a vertex of the rebuilt one that is not on the data became it.
std::vector<std::uint8_t> made_up_vertices(const geometry::RebuiltSurface& rebuilt,
                                           const RepairedMesh& closed) {
  std::vector<std::uint8_t> made_up(closed.mesh.positions.size(), 0);
  for (std::size_t v = 0; v < rebuilt.measured.size(); ++v)
    if (const Index to = closed.vertex_of_input[v]; to != kNoIndex && !rebuilt.measured[v]) made_up[to] = 1;
  return made_up;
}

/// The warnings of the repair, except those about the surface that was replaced.
std::vector<engine::Warning> kept_warnings(const geometry::RepairReport& report) {
  std::vector<engine::Warning> kept = report.warnings;
  std::erase_if(kept, [](const engine::Warning& w) {
    return w.code == "open-edges" || w.code == "non-manifold-edges" || w.code == "not-orientable";
  });
  return kept;
}

engine::Warning rebuilt_warning(std::size_t pieces, std::size_t open_edges, double measured) {
  const long made_up = std::lround(100.0 * (1.0 - measured));
  return {"skin-rebuilt", "",
          "The skin was closed: the file gives it in " + std::to_string(pieces) +
              (pieces == 1 ? " piece with " : " pieces with ") + std::to_string(open_edges) +
              " open edges; " + std::to_string(made_up) + " % of the closed skin is not in the file.",
          made_up > kMuchMadeUp
              ? "Scan from more sides, also from below, for a skin that is measured everywhere."
              : "",
          made_up <= kMuchMadeUp};
}

}  // namespace

std::optional<ClosedSkin> close_skin(const engine::Context& context, const TriMesh& input,
                                     const RepairedMesh& repaired) {
  if (repaired.mesh.triangles.size() < kFewestTriangles) return std::nullopt;
  if (openness(repaired) < kNearlyClosed) return std::nullopt;
  const TriMesh surface = outward(input, repaired);
  const Vec3 size = geometry::bounding_box(surface.positions).size();
  if (surface_area(surface) > kTooCompact * size.squaredNorm()) return std::nullopt;
  const double cell = std::max(size.maxCoeff() / kCells, std::cbrt(size.prod() / kMostNodes));
  geometry::RebuiltSurface rebuilt = geometry::rebuild(context, surface, cell);
  if (rebuilt.mesh.empty() || rebuilt.measured_share < kLeastMeasured) return std::nullopt;
  auto closed = geometry::repair(context, rebuilt.mesh);
  if (!closed) return std::nullopt;
  std::vector<std::uint8_t> made_up = made_up_vertices(rebuilt, *closed);
  RepairedMesh out = std::move(*closed);
  out.vertex_of_input = map_vertices(context, input, repaired, out.mesh);
  out.triangle_of_input.assign(input.triangles.size(), kNoIndex);
  out.report.welded = repaired.report.welded;
  out.report.dropped_vertices = repaired.report.dropped_vertices;
  out.report.dropped_triangles = repaired.report.dropped_triangles;
  out.report.warnings = kept_warnings(repaired.report);
  out.report.warnings.push_back(
      rebuilt_warning(repaired.report.components, repaired.report.boundary_edges, rebuilt.measured_share));
  if (rebuilt.lost_share > kMuchLost)
    out.report.warnings.push_back(
        {"skin-lost", "",
         "Some of the file's surface, " + std::to_string(std::lround(1e4 * rebuilt.lost_share)) +
             " of 10,000 parts, is not in the closed skin: tips of fingers or toes, or patches that lie "
             "apart.",
         "Check hands and feet; scan them from more sides, or close the mesh before."});
  return ClosedSkin{std::move(out), std::move(made_up)};
}

}  // namespace bodice::io
