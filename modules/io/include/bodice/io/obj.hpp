// Writing meshes as Wavefront OBJ, and reading the positions of such a file.
#pragma once

#include <filesystem>
#include <vector>

#include <bodice/engine/result.hpp>
#include <bodice/geometry/frame.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::io {

/// Writes a mesh as Wavefront OBJ in the unit and axes of `frame`, with enough digits to read the same floats
/// back. The file appears whole or not at all. Fails with kWriteFailed.
engine::Result<void> write_obj(const geometry::TriMesh& mesh, const std::filesystem::path& file,
                               const geometry::Frame& frame = {});

/// The positions of an OBJ file as they stand there, one a line `v`, used or not. Fails with kNotFound where
/// the file cannot be read, and with kUnreadable where it has no vertex or one that is no three numbers.
engine::Result<std::vector<geometry::Vec3>> read_obj_positions(const std::filesystem::path& file);

}  // namespace bodice::io
