// A mesh prepared for the analysis.
#pragma once

#include <bodice/geodesic/distance.hpp>
#include <bodice/geodesic/isoline.hpp>

namespace bodice::inline v0_1::anatomy {

/// The mesh with what every step needs: built once, read by all. Keeps a reference to the mesh, which must
/// outlive it.
struct Skin {
  const geometry::TriMesh& mesh;
  geometry::MeshEdges edges;
  geodesic::EdgeGraph graph;
  std::vector<geometry::Index> component;  ///< #V; 0 is the body's own
  std::size_t components = 0;              ///< vertices without triangles are some of them
  std::size_t pieces = 0;                  ///< components that have triangles
  std::size_t open_edges = 0;              ///< of the input, at its holes
  /// The genus of the body's own component: 0 without welds between limbs, and on a skin with holes, on which
  /// handles cannot be counted.
  int handles = 0;
};

/// A point on an edge of the skin.
struct SkinPoint {
  geometry::Index edge = geometry::kNoIndex;
  geometry::Vec3 position = geometry::Vec3::Zero();
  bool found() const { return edge != geometry::kNoIndex; }
};

/// The field at a point, between the ends of its edge. Precondition: point.found().
float value_at(const Skin& skin, const SkinPoint& point, std::span<const float> field);

Skin make_skin(const engine::Context& context, const geometry::TriMesh& mesh);

/// Twice the outward area of the triangle that meets the edge first: which side of a curve is outside.
geometry::Vec3 normal_at_edge(const Skin& skin, geometry::Index edge);

}  // namespace bodice::anatomy
