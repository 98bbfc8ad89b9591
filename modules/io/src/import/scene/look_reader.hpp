// Reads how the meshes of a scene look: of glTF from its document, of other formats from assimp's scene.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "import/look/gltf_look.hpp"
#include "import/look/scene_look.hpp"
#include "import/scene/gltf_rig.hpp"
#include "import/source/file_format.hpp"

namespace bodice::inline v0_1::io {

/// A mesh of a node of the scene.
struct NodeMesh {
  std::uint32_t node = 0;     ///< of SceneNodes
  std::size_t primitive = 0;  ///< among the meshes of that node
  const aiNode* scene_node = nullptr;
};

class LookReader {
 public:
  /// `gltf` is null for other formats. `materials`: has_materials() of the file. All must outlive this.
  LookReader(const aiScene& scene, const GltfRig* gltf, const std::filesystem::path& folder, bool materials,
             FileLook& out);

  MeshLook of(const aiMesh& mesh, const NodeMesh& from, std::span<const geometry::Triangle> triangles);

 private:
  const GltfRig* gltf_;
  bool materials_;
  std::optional<GltfLook> gltf_look_;
  SceneLook scene_look_;
};

/// Whether materials can be those of the file: assimp makes some up for an OBJ without its library.
bool has_materials(const std::filesystem::path& file, Format format);

/// Whether assimp's readers made a name up because the file gives none.
bool is_made_up(std::string_view name);

}  // namespace bodice::io
