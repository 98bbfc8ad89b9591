// Repair: the mesh that a file gives is welded, freed of what is unusable and oriented, and a report lists
// the changes.
#pragma once

#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::geometry {

/// Vertices nearer to each other than this fraction of the bounding box's diagonal are welded. Files keep 6
/// or more digits, and real bodies have no edges this short.
inline constexpr double kWeldRelative = 1e-6;

/// What repair() changes, and from which distance on it welds.
struct RepairOptions {
  double weld_relative = kWeldRelative;  ///< fraction of the bounding box's diagonal
  bool orient = true;                    ///< make the winding of each component consistent and outward
  bool drop_fins = true;                 ///< drops fins of a body; on a garment they may be pockets or trims
};

/// What repair() changed, counted, and what is wrong with the surface that it leaves.
struct RepairReport {
  std::size_t welded = 0;             ///< input vertices merged into another
  std::size_t dropped_vertices = 0;   ///< NaN, Inf or unreferenced
  std::size_t dropped_triangles = 0;  ///< zero area, duplicate, fin, or on a dropped vertex
  std::size_t flipped_triangles = 0;
  std::size_t components = 0;
  std::size_t boundary_edges = 0;      ///< edges with one triangle
  std::size_t non_manifold_edges = 0;  ///< edges with three or more triangles
  int euler_characteristic = 0;
  std::vector<engine::Warning> warnings;
};

/// A repaired mesh, and the numbers in it of the input's vertices and triangles.
struct RepairedMesh {
  TriMesh mesh;
  std::vector<Index> vertex_of_input;    ///< #input vertices: the welded vertex, or kNoIndex if dropped
  std::vector<Index> triangle_of_input;  ///< #input triangles: the kept triangle, or kNoIndex
  RepairReport report;
};

/// Welds by position, drops what cannot be used and orients each component outward. The vertices keep the
/// order of their first use. O(n log n). Fails with kUnusableGeometry when no triangle is left, with
/// kInvalidArgument for a weld distance outside [0, 1), and with kCanceled.
engine::Result<RepairedMesh> repair(const engine::Context& context, const TriMesh& input,
                                    const RepairOptions& options = {});

/// The component of each vertex, numbered by falling area.
struct Components {
  std::vector<Index> of_vertex;
  std::vector<double> area;  ///< square meters, one a component
};
/// Finds the components of a mesh: triangles that share a vertex are connected. A vertex without a triangle
/// is a component of its own. O(n log n).
Components connected_components(const TriMesh& mesh);

/// The `count` largest components of a mesh, with the vertices that their triangles use, in the order of
/// these. `components`: those of `mesh`. O(#V + #F).
TriMesh largest_components(const TriMesh& mesh, const Components& components, std::size_t count);

}  // namespace bodice::geometry
