// Materials and texture coordinates of OBJ, FBX and Collada files, as assimp reads them, in the words of
// glTF.
#pragma once

#include <filesystem>
#include <string>
#include <unordered_map>
#include <vector>

#include <assimp/scene.h>

#include "import/look/mesh_look.hpp"

namespace bodice::inline v0_1::io {

/// Takes materials of a scene one by one, each once.
class SceneLook {
 public:
  /// `folder` holds the images that the file names. All must outlive this.
  SceneLook(const aiScene& scene, const std::filesystem::path& folder, FileLook& out);

  /// The number in `out` of a material of the scene; kNoMaterial where it does not exist.
  std::uint32_t material(std::size_t index);
  /// Reads all texture coordinates of a mesh with these triangles.
  static void read_uv(const aiMesh& mesh, std::span<const geometry::Triangle> triangles, MeshLook& look);

 private:
  /// A reference to the first texture of one of these kinds, or null.
  engine::SortedJson texture(const aiMaterial& material, std::initializer_list<aiTextureType> kinds);
  std::optional<std::size_t> image(const std::string& name);
  std::string bytes_of(const std::string& name) const;
  void warn_of_lost_textures(const aiMaterial& material);

  const aiScene& scene_;
  const std::filesystem::path& folder_;
  FileLook& out_;
  std::vector<std::uint32_t> materials_;                                // of the scene -> in out_
  std::unordered_map<std::string, std::optional<std::size_t>> images_;  // looked up only
};

/// The file that a material names, where it is, or beside the material by its last name: paths of the
/// machine that wrote the material are common. Empty where there is none.
std::filesystem::path find_image(std::string name, const std::filesystem::path& folder);

}  // namespace bodice::io
