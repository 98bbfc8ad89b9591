#include <bodice/tryon/wearing.hpp>

#include <algorithm>
#include <limits>

#include <bodice/geometry/mesh_edges.hpp>
#include <bodice/geometry/mesh_repair.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Index;
using geometry::Vec3;

/// The height of a waistband, in statures (about 1.5 cm).
constexpr double kWaistbandHeight = 0.009;
/// A piece is worn if some of it is this close to the skin, in statures.
constexpr double kWornWithin = 0.06;

/// The coordinate along the trunk, from feet to head.
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

struct Piece {
  double top = -std::numeric_limits<double>::infinity();
  bool worn = false;
  std::vector<Index> waistband;                                        ///< the rim closest to the head
  double waistband_height = -std::numeric_limits<double>::infinity();  ///< the rim's mean, as it may slant
};

std::vector<Piece> find_pieces(const geometry::TriMesh& mesh, const geometry::Components& components,
                               const SegmentedSkin& body) {
  std::vector<Piece> pieces(components.area.size());
  const double near_m = kWornWithin * body.anatomy.stature_m;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    Piece& piece = pieces[components.of_vertex[v]];
    piece.top = std::max(piece.top, height_of(mesh.positions[v], body));
    piece.worn = piece.worn || body.distance->closest_point_within(mesh.positions[v], near_m).has_value();
  }
  for (std::vector<Index>& rim : geometry::boundary_loops(mesh, geometry::mesh_edges(mesh))) {
    double height = 0.0;
    for (const Index v : rim) height += height_of(mesh.positions[v], body);
    height /= static_cast<double>(rim.size());
    Piece& piece = pieces[components.of_vertex[rim.front()]];
    if (height <= piece.waistband_height) continue;
    piece.waistband_height = height;
    piece.waistband = std::move(rim);
  }
  return pieces;
}

/// Marks the vertices of the rim's piece within the band's width of the rim. Another piece that lies over the
/// band, such as a shirt over trousers, stays free.
void mark_band(const geometry::TriMesh& mesh, const geometry::Components& components,
               const std::vector<Index>& rim, double width_m, std::vector<bool>& held) {
  const auto is_near_rim = [&](const Vec3& p) {
    return std::ranges::any_of(
        rim, [&](Index v) { return (p - mesh.positions[v]).squaredNorm() <= width_m * width_m; });
  };
  const Index piece = components.of_vertex[rim.front()];
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    if (components.of_vertex[v] == piece && is_near_rim(mesh.positions[v])) held[v] = true;
}

}  // namespace

engine::Result<WornGarment> make_garment(const engine::Context& context, const SegmentedSkin& skin,
                                         const synth::GarmentOptions& options) {
  const synth::SegmentedBody body{.mesh = skin.input.skin,
                                  .part = skin.anatomy.part,
                                  .landmarks = skin.anatomy.landmarks,
                                  .stature_m = skin.anatomy.stature_m};
  auto made = synth::make_garment(context, body, options);
  if (!made) return std::move(made).error();
  return WornGarment{std::string(name(options.kind)), std::move(made->mesh), std::move(made->pinned)};
}

std::vector<Index> held_vertices(const geometry::TriMesh& garment, const SegmentedSkin& body) {
  const auto welded = geometry::repair({}, garment, {.orient = false, .drop_fins = false});
  if (!welded) return {};
  const geometry::TriMesh& mesh = welded->mesh;
  const geometry::Components components = geometry::connected_components(mesh);
  const double shoulder = armpit_height(body);
  std::vector<bool> in_band(mesh.positions.size(), false);
  for (const Piece& piece : find_pieces(mesh, components, body))
    if (piece.worn && piece.top <= shoulder && !piece.waistband.empty())
      mark_band(mesh, components, piece.waistband, kWaistbandHeight * body.anatomy.stature_m, in_band);

  std::vector<Index> held;
  for (std::size_t i = 0; i < garment.positions.size(); ++i) {
    const Index v = welded->vertex_of_input[i];
    if (v != geometry::kNoIndex && in_band[v]) held.push_back(static_cast<Index>(i));
  }
  return held;
}

}  // namespace bodice::tryon
