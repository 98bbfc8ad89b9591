#include "import/scene/joined_look.hpp"

#include <algorithm>

namespace bodice::inline v0_1::io {

namespace {

/// The names of the nodes, each once, in their order.
std::string joined_names(std::span<const FileMesh> meshes) {
  std::vector<std::string> names;
  for (const FileMesh& mesh : meshes)
    if (!mesh.look.node.empty() && std::ranges::find(names, mesh.look.node) == names.end())
      names.push_back(mesh.look.node);
  std::string joined;
  for (const std::string& name : names) joined += (joined.empty() ? "" : " + ") + name;
  return joined;
}

}  // namespace

std::shared_ptr<const Look> joined_look(FileLook file, std::span<const FileMesh> meshes,
                                        std::span<const geometry::Index> triangle_of_input) {
  auto look = std::make_shared<Look>();
  look->name = joined_names(meshes);
  look->materials = std::move(file.materials);
  for (const FileMesh& mesh : meshes) look->uv_sets = std::max(look->uv_sets, mesh.look.uv_sets);
  if (look->name.empty() && look->uv_sets == 0 && look->materials.materials.empty()) return nullptr;
  std::size_t input = 0;
  for (const FileMesh& mesh : meshes) {
    const std::size_t own = 2 * mesh.look.uv_sets;
    for (std::size_t t = 0; t < mesh.shape.triangles.size(); ++t, ++input) {
      if (triangle_of_input[input] == geometry::kNoIndex) continue;  // the kept ones keep their order
      look->material.push_back(mesh.look.material);
      for (std::size_t corner = 3 * t; corner < 3 * t + 3; ++corner)
        for (std::size_t k = 0; k < 2 * look->uv_sets; ++k)
          look->uv.push_back(k < own ? mesh.look.uv[corner * own + k] : 0.0f);
    }
  }
  return look;
}

}  // namespace bodice::io
