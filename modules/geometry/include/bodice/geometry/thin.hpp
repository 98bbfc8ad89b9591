// A surface with fewer vertices, for meshes that are finer than they need be.
#pragma once

#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/noise.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::geometry {

/// What thin() may remove.
struct ThinOptions {
  double edge_m = 0.0;       ///< edges from this length on stay
  double tolerance_m = 0.0;  ///< no removed vertex lies farther off the planes that replace it
};

/// A surface on some of the vertices of another one.
struct ThinnedSurface {
  TriMesh mesh;                          ///< vertices and triangles in the order of the input
  std::vector<Index> kept;               ///< #V: the input vertex that each is
  std::vector<Index> vertex_of_input;    ///< #V of the input: the vertex that it is, or was merged into
  std::vector<Index> triangle_of_input;  ///< #F of the input: the triangle that it became, or kNoIndex
};

/// Merges the ends of short edges, each into a vertex that is there, as long as the surface keeps its
/// topology, its shape and the shape of its triangles. Rims and non-manifold edges stay. Slabs of the surface
/// are thinned one beside the other, the same ones for any number of workers. Cost: about a microsecond a
/// vertex. Throws Canceled. Preconditions: every index of a triangle is below #V; positions are finite.
ThinnedSurface thin(const engine::Context& context, const TriMesh& mesh, const ThinOptions& options);

/// The same of a surface with noise of a standard deviation: its shape is judged without, and what stays of
/// it moves along its normals onto quadrics through what was merged around it. Cost: also some two
/// microseconds a vertex that stays.
ThinnedSurface thin_noisy(const engine::Context& context, const RoughSurface& surface, double noise,
                          ThinOptions options);

}  // namespace bodice::geometry
