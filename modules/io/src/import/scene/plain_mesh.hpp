// Readers for the plainest files of a body: one mesh without bones, which scanners write with millions of
// vertices.
#pragma once

#include <filesystem>
#include <optional>

#include "import/scene/file_scene.hpp"
#include "import/source/file_format.hpp"

namespace bodice::inline v0_1::io {

/// Reads an OBJ or a binary PLY of one mesh, several times as fast as assimp and to the same bits. Gives
/// nothing for files that hold more or have flaws: assimp reads those.
std::optional<FileMesh> read_plain_mesh(const std::filesystem::path& file, Format format);

/// The same for texts in memory; the mesh has the name that the text gives it.
std::optional<FileMesh> read_plain_obj(const std::string& text);
std::optional<FileMesh> read_plain_ply(const std::string& bytes);

}  // namespace bodice::io
