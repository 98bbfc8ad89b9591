#include <bodice/tryon/wearing.hpp>

#include <algorithm>
#include <limits>
#include <map>

#include <bodice/geometry/mesh_repair.hpp>

namespace bodice::tryon {
namespace {

using geometry::Index;
using geometry::Vec3;

/// A waistband holds vertices up to this far below its edge, as a fraction of stature (about 1.5 cm).
constexpr double kWaistbandHeight = 0.009;
/// A piece is worn only if some of it comes this near the skin, as a fraction of stature.
constexpr double kWornWithin = 0.06;

/// Height along the trunk, feet to head.
double height_of(const Vec3& p, const SegmentedSkin& body) {
  return p.dot(body.anatomy.up);
}

double armpit_height(const SegmentedSkin& body) {
  double height = std::numeric_limits<double>::infinity();
  for (const body::Landmark& landmark : body.anatomy.landmarks)
    if ((landmark.id == body::LandmarkId::kArmpitL || landmark.id == body::LandmarkId::kArmpitR) &&
        landmark.confidence > 0.0)
      height = std::min(height, height_of(landmark.position, body));
  return height;
}

/// Vertices on an edge that only one triangle has, seams closed by position first.
std::vector<bool> boundary_vertices(const geometry::TriMesh& mesh) {
  std::map<std::pair<Index, Index>, int> uses;
  for (const geometry::Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++uses[std::minmax(t[k], t[(k + 1) % 3])];
  std::vector<bool> on_boundary(mesh.positions.size(), false);
  for (const auto& [edge, count] : uses)
    if (count == 1) on_boundary[edge.first] = on_boundary[edge.second] = true;
  return on_boundary;
}

struct Piece {
  double top = -std::numeric_limits<double>::infinity();
  double boundary_top = -std::numeric_limits<double>::infinity();
  bool worn = false;
};

}  // namespace

std::vector<Index> held_vertices(const geometry::TriMesh& garment, const SegmentedSkin& body) {
  const auto welded = geometry::repair({}, garment, {.orient = false});
  if (!welded) return {};
  const geometry::TriMesh& mesh = welded->mesh;
  const geometry::Components components = geometry::connected_components(mesh);
  const std::vector<bool> on_boundary = boundary_vertices(mesh);
  const double stature_m = body.anatomy.stature_m;

  std::vector<Piece> pieces(components.area.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    Piece& piece = pieces[components.of_vertex[v]];
    const double height = height_of(mesh.positions[v], body);
    piece.top = std::max(piece.top, height);
    if (on_boundary[v]) piece.boundary_top = std::max(piece.boundary_top, height);
    if (!piece.worn && body.distance->nearest_within(mesh.positions[v], kWornWithin * stature_m))
      piece.worn = true;
  }

  const double shoulder = armpit_height(body);
  std::vector<Index> held;
  for (std::size_t i = 0; i < garment.positions.size(); ++i) {
    const Index v = welded->vertex_of_input[i];
    if (v == geometry::kNoIndex) continue;
    const Piece& piece = pieces[components.of_vertex[v]];
    if (!piece.worn || piece.top > shoulder) continue;
    if (height_of(mesh.positions[v], body) > piece.boundary_top - kWaistbandHeight * stature_m)
      held.push_back(static_cast<Index>(i));
  }
  return held;
}

}  // namespace bodice::tryon
