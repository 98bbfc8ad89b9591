#include "import/scene/look_reader.hpp"

#include <algorithm>

#include "import/source/obj_materials.hpp"

namespace bodice::inline v0_1::io {

LookReader::LookReader(const aiScene& scene, const GltfRig* gltf, const std::filesystem::path& folder,
                       bool materials, FileLook& out)
    : gltf_(gltf), materials_(materials), scene_look_(scene, folder, out) {
  if (gltf) gltf_look_.emplace(gltf->document(), folder, out);
}

MeshLook LookReader::of(const aiMesh& mesh, const NodeMesh& from,
                        std::span<const geometry::Triangle> triangles) {
  MeshLook look;
  if (gltf_) {
    look.node = text_at(gltf_->node(from.node), "name");
    const engine::SortedJson& primitive = gltf_->primitive(from.node, from.primitive);
    gltf_look_->read_uv(primitive, mesh.mNumVertices, triangles, look);
    if (const auto material = index_at(primitive, "material"))
      look.material = gltf_look_->material(*material);
    return look;
  }
  if (const std::string name = from.scene_node->mName.C_Str(); !is_made_up(name)) look.node = name;
  SceneLook::read_uv(mesh, triangles, look);
  if (materials_) look.material = scene_look_.material(mesh.mMaterialIndex);
  return look;
}

bool has_materials(const std::filesystem::path& file, Format format) {
  if (format != Format::kObj) return traits_of(format).has_materials;
  return std::ranges::any_of(material_libraries(file), [](const std::filesystem::path& library) {
    std::error_code error;
    return std::filesystem::is_regular_file(library, error);
  });
}

bool is_made_up(std::string_view name) {
  return name.empty() || name == "defaultobject" || name == "DefaultMaterial" || name.starts_with('<');
}

}  // namespace bodice::io
