#pragma once

#include <filesystem>

#include <bodice/geometry/tri_mesh.hpp>

namespace bench {

/// A minimal reader of OBJ (v, f), binary PLY and binary STL, so that this bench needs no importer.
bodice::geometry::TriMesh read_mesh(const std::filesystem::path& file);

}  // namespace bench
