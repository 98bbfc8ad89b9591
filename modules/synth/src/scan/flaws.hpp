// The flaws that scanners give a surface.
#pragma once

#include <span>
#include <vector>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::synth {

/// The triangles with this value, with the vertices that they use.
geometry::TriMesh take(const geometry::TriMesh& mesh, std::span<const int> value, int wanted);
/// The triangles with any other value, with the vertices that they use.
geometry::TriMesh take_others(const geometry::TriMesh& mesh, std::span<const int> value, int unwanted);

/// Moves each vertex along its normal by normal noise.
void add_noise(double sigma_m, engine::Random& random, geometry::TriMesh& mesh);

/// Moves each vertex along its normal by waves of 10 to 30 cm.
void add_waves(double height_m, engine::Random& random, geometry::TriMesh& mesh);

/// Moves each vertex within its tangent plane by a share of its shortest edge, so that triangles go bad.
void jitter(double share, engine::Random& random, geometry::TriMesh& mesh);

/// Appends the vertices and triangles of another mesh.
void append(const geometry::TriMesh& mesh, geometry::TriMesh& to);

/// Moves all vertices.
void shift(const geometry::Vec3& by, geometry::TriMesh& mesh);

}  // namespace bodice::synth
