// Noise of a scanned surface: how strong it is, and the surface without it.
#pragma once

#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/neighbors.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::geometry {

/// A mesh that may be noisy, with its neighbors and normals, which are needed to measure noise and to remove
/// it. The mesh has to outlive it. Precondition: every index of a triangle is below #V.
struct RoughSurface {
  RoughSurface(const TriMesh& of) : mesh(of), neighbors(of), normals(vertex_normals(of)) {}  // NOLINT
  const TriMesh& mesh;
  Neighbors neighbors;
  std::vector<Vec3> normals;  ///< #V, as vertex_normals() gives them
};

/// The standard deviation of the noise along the normals, in the mesh's unit; 0 where the surface is clean.
/// A vertex is compared with a quadric through its neighbors.
/// Noise differs from shape by its correlation: neighbors of a bent surface deviate alike, those of noise do
/// not. Noise below .0004 of the longest side, and of meshes so coarse that shape hides it, counts as none.
/// Cost: some milliseconds and O(#F); on noisy surfaces microseconds a vertex. Throws Canceled.
double noise_of(const engine::Context& context, const RoughSurface& surface);

/// The positions (#V) with noise of a standard deviation removed. Around each vertex a quadric is fitted to
/// as many rings of neighbors as agree with the fewer ones within the noise, the rule of Goldenshluger and
/// Nemirovski (1997); the vertex moves along its normal by all quadrics that go through it, weighed by their
/// variances and sizes. Flat skin is averaged widely, fingers and ears hardly. Cost: some twenty microseconds
/// a vertex, on all workers. Throws Canceled.
std::vector<Vec3> without_noise(const engine::Context& context, const RoughSurface& surface, double noise);

}  // namespace bodice::geometry
