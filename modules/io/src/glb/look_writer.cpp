#include "look_writer.hpp"

namespace bodice::inline v0_1::io {

namespace {

void add_images(const Materials& materials, GlbBuilder& glb) {
  for (const LookImage& image : materials.images) {
    Json object;
    if (!image.name.empty()) object["name"] = image.name;
    object["mimeType"] = image.mime_type;
    object["bufferView"] = glb.add_image_bytes(image.bytes);
    glb.add("images", std::move(object));
  }
}

void use_extensions(const engine::SortedJson& object, GlbBuilder& glb) {
  std::vector<std::string> names;
  collect_extensions(object, names);
  for (const std::string& name : names) glb.use(name);
}

}  // namespace

std::vector<std::size_t> add_materials(const Materials& materials, GlbBuilder& glb) {
  const std::size_t first_image = glb.size("images"), first_sampler = glb.size("samplers"),
                    first_texture = glb.size("textures");
  add_images(materials, glb);
  for (const engine::SortedJson& sampler : materials.samplers) {
    use_extensions(sampler, glb);
    glb.add("samplers", Json(sampler));
  }
  for (engine::SortedJson texture : materials.textures) {
    renumber_images(texture, [&](std::size_t at, bool) { return std::optional(first_image + at); });
    if (texture.contains("sampler"))
      texture["sampler"] = first_sampler + texture["sampler"].get<std::size_t>();
    use_extensions(texture, glb);
    glb.add("textures", Json(texture));
  }
  std::vector<std::size_t> added;
  for (engine::SortedJson material : materials.materials) {
    renumber_textures(material, [&](std::size_t at) { return std::optional(first_texture + at); });
    use_extensions(material, glb);
    added.push_back(glb.add("materials", Json(material)));
  }
  for (const std::string& extension : materials.required) glb.require(extension);
  return added;
}

}  // namespace bodice::io
