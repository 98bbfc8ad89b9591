// Small meshes with known area and volume, wound outward, in meters.
#pragma once

#include <cstdint>

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice_test {

using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;

/// A sphere's inscribed icosahedron, each triangle split in four `subdivisions` times: 20 * 4^n triangles.
TriMesh icosphere(double radius_m, int subdivisions, const Vec3& center = Vec3::Zero());

/// An axis-aligned box, two triangles a cell, `cells` cells along each edge of a face.
TriMesh box(const Vec3& half_size_m, int cells = 1, const Vec3& center = Vec3::Zero());

/// A cylinder around y from -height/2 to height/2. It is closed by two fans around cap centers, or open at
/// both ends.
TriMesh cylinder(double radius_m, double height_m, int around, int along, bool caps = true);

/// A torus around y, of genus 1.
TriMesh torus(double major_m, double minor_m, int around, int across);

/// A flat sheet in the xz plane, normals +y, centerd.
TriMesh sheet(double width_m, double depth_m, int cells_x, int cells_z);

/// Both meshes side by side in one; nothing is welded.
TriMesh joined(const TriMesh& a, const TriMesh& b);

/// The mesh with three vertices of its own for every triangle, as in STL files.
TriMesh soup(const TriMesh& mesh);

/// The mesh with its positions p replaced by scale * p + offset.
TriMesh moved(TriMesh mesh, double scale, const Vec3& offset);

/// The same surface with vertices and triangles renumbered and corners rotated, by seed.
TriMesh shuffled(const TriMesh& mesh, std::uint64_t seed);

}  // namespace bodice_test
