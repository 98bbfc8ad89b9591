#pragma once

#include <cstdint>

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::fitting {

/// The hash that identifies the mesh a proxy was fitted to: BodyProxy::source_hash.
std::uint64_t skin_hash(const geometry::TriMesh& mesh);

}  // namespace bodice::fitting
