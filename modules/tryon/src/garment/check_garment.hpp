// Checks a garment in memory before its corners are read.
#pragma once

#include <span>
#include <string_view>

#include <bodice/engine/message.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::tryon {

/// Fails with kInvalidArgument, naming the triangle, when one refers to a missing vertex.
inline engine::Result<void> check_triangles(const geometry::TriMesh& mesh, std::string_view name) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const geometry::Index v : mesh.triangles[t])
      if (v >= mesh.positions.size())
        return engine::Error{
            engine::ErrorCode::kInvalidArgument,
            engine::message(name, ": triangle ", t, " names vertex ", v, " of ", mesh.positions.size(), "."),
            "Repair the mesh first (geometry::repair)."};
  return {};
}

inline engine::Result<void> check_triangles(std::span<const geometry::TriMesh> garments) {
  for (std::size_t g = 0; g < garments.size(); ++g)
    if (auto good = check_triangles(garments[g], engine::message("Garment ", g)); !good) return good;
  return {};
}

}  // namespace bodice::tryon
