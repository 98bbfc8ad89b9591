// The proxy's surface as triangles, to look at or for tools that collide with meshes.
#pragma once

#include <cstdint>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/proxy/body_proxy.hpp>

namespace bodice::inline v0_1::proxy {

/// The proxy's surface as a mesh, with a normal and an owner a vertex.
struct ProxySurface {
  geometry::TriMesh mesh;               ///< closed, wound outward
  std::vector<geometry::Vec3> normals;  ///< #V, unit gradients of the distance
  std::vector<std::uint32_t> owner;     ///< #V, indices into BodyProxy::ellipsoids()
};

/// The zero set of proxy_distance(), sampled on a cubic lattice of `cell_m`. What is thinner than a cell may
/// be missed, and creases are rounded within a cell; other vertices lie within a thousandth of a cell of the
/// surface. Every edge is shared by two triangles; where the surface touches itself within a cell, its sheets
/// are set apart by a fiftieth of a cell. A proxy without ellipsoids has no surface. The bits do not depend
/// on the number of workers. Fails with kInvalidArgument if the cell is not positive, or so small that the
/// surface takes millions of them, and with kCanceled. Cost: two or three scalar distances a vertex. A body
/// of 89 ellipsoids with relief, at a three-hundredth of its stature, has 80,000 vertices and takes a second
/// of one core.
// Based on: Sarah F. F. Gibson. Constrained Elastic Surface Nets. 1998.
// Differs: only cells that the surface crosses are visited, each from a neighbor; vertices go down the
// distance's gradient in place of relaxing.
engine::Result<ProxySurface> proxy_surface(const engine::Context& context, const BodyProxy& proxy,
                                           double cell_m);

}  // namespace bodice::proxy
