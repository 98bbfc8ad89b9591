#pragma once

#include <filesystem>

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice_test {

/// The positions and faces of an OBJ file (polygons fanned, everything else ignored) or of a binary STL, in
/// the file's units. Enough for the project's own data, so that suites below io need no importer. Empty if
/// the file cannot be read.
bodice::geometry::TriMesh read_mesh(const std::filesystem::path& file);

}  // namespace bodice_test
