#pragma once

#include <filesystem>

#include <bodice/engine/result.hpp>
#include <bodice/geometry/frame.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::io {

/// Writes a mesh as Wavefront OBJ in the unit and axes of `frame`, with enough digits to read the same floats
/// back. The file appears whole or not at all. Fails with kWriteFailed.
engine::Result<void> write_obj(const geometry::TriMesh& mesh, const std::filesystem::path& file,
                               const geometry::Frame& frame = {});

}  // namespace bodice::io
