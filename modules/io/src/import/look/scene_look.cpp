// Based on: Walter, Marschner, Li, Torrance. Microfacet Models for Refraction through Rough Surfaces. 2007.
// - the roughness of a shininess
#include "import/look/scene_look.hpp"

#include <algorithm>
#include <cmath>

#include <assimp/material.h>

#include <bodice/engine/message.hpp>

#include "import/source/input_file.hpp"

namespace bodice::inline v0_1::io {

namespace {

using engine::SortedJson;

constexpr float kClothRoughness = 0.85f;
constexpr int kClampToEdge = 33071, kMirroredRepeat = 33648,
              kRepeat = 10497;  // OpenGL's numbers, which glTF uses, too

float in_unit(float value, float otherwise) {
  return std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : otherwise;
}

/// glTF's roughness is the root of that of microfacets, which is sqrt(2 / (2 + shininess)).
float roughness_of(const aiMaterial& material) {
  float value = 0.0f;
  if (material.Get(AI_MATKEY_ROUGHNESS_FACTOR, value) == aiReturn_SUCCESS)
    return in_unit(value, kClothRoughness);
  if (material.Get(AI_MATKEY_SHININESS, value) == aiReturn_SUCCESS && value > 0.0f && std::isfinite(value))
    return std::pow(2.0f / (2.0f + value), 0.25f);
  return kClothRoughness;
}

SortedJson color_of(const aiColor3D& color) {
  return {in_unit(color.r, 1.0f), in_unit(color.g, 1.0f), in_unit(color.b, 1.0f)};
}

int wrap_of(const aiMaterial& material, aiTextureType kind, bool v) {
  int mode = aiTextureMapMode_Wrap;
  if (v)
    material.Get(AI_MATKEY_MAPPINGMODE_V(kind, 0), mode);
  else
    material.Get(AI_MATKEY_MAPPINGMODE_U(kind, 0), mode);
  return mode == aiTextureMapMode_Clamp    ? kClampToEdge
         : mode == aiTextureMapMode_Mirror ? kMirroredRepeat
                                           : kRepeat;
}

}  // namespace

SceneLook::SceneLook(const aiScene& scene, const std::filesystem::path& folder, FileLook& out)
    : scene_(scene), folder_(folder), out_(out), materials_(scene.mNumMaterials, kNoMaterial) {}

std::uint32_t SceneLook::material(std::size_t index) {
  if (index >= materials_.size()) return kNoMaterial;
  if (materials_[index] != kNoMaterial) return materials_[index];
  const aiMaterial& from = *scene_.mMaterials[index];
  SortedJson base = texture(from, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE});
  aiColor3D diffuse(1.0f, 1.0f, 1.0f);
  // As in most programs, a texture replaces the color.
  if (base.is_null() && from.Get(AI_MATKEY_BASE_COLOR, diffuse) != aiReturn_SUCCESS)
    from.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse);
  float opacity = 1.0f, metallic = 0.0f;
  from.Get(AI_MATKEY_OPACITY, opacity);
  from.Get(AI_MATKEY_METALLIC_FACTOR, metallic);
  SortedJson factor = color_of(diffuse);
  factor.push_back(in_unit(opacity, 1.0f));
  SortedJson out = {{"name", from.GetName().C_Str()}, {"doubleSided", true}};
  out["pbrMetallicRoughness"] = {{"baseColorFactor", factor},
                                 {"metallicFactor", in_unit(metallic, 0.0f)},
                                 {"roughnessFactor", roughness_of(from)}};
  if (!base.is_null()) out["pbrMetallicRoughness"]["baseColorTexture"] = std::move(base);
  if (opacity < 1.0f) out["alphaMode"] = "BLEND";
  if (SortedJson normal = texture(from, {aiTextureType_NORMALS}); !normal.is_null())
    out["normalTexture"] = std::move(normal);
  aiColor3D emissive(0.0f, 0.0f, 0.0f);
  from.Get(AI_MATKEY_COLOR_EMISSIVE, emissive);
  if (SortedJson glow = texture(from, {aiTextureType_EMISSIVE}); !glow.is_null()) {
    out["emissiveTexture"] = std::move(glow);
    out["emissiveFactor"] = {1, 1, 1};
  } else if (!emissive.IsBlack()) {
    out["emissiveFactor"] = color_of(emissive);
  }
  warn_of_lost_textures(from);
  materials_[index] = static_cast<std::uint32_t>(out_.materials.materials.size());
  out_.materials.materials.push_back(std::move(out));
  return materials_[index];
}

void SceneLook::read_uv(const aiMesh& mesh, std::span<const geometry::Triangle> triangles, MeshLook& look) {
  while (look.uv_sets < AI_MAX_NUMBER_OF_TEXTURECOORDS &&
         mesh.HasTextureCoords(static_cast<unsigned>(look.uv_sets)))
    ++look.uv_sets;
  const auto finite = [](float value) { return std::isfinite(value) ? value : 0.0f; };
  for (const geometry::Triangle& triangle : triangles)
    for (const geometry::Index v : triangle)
      for (std::size_t set = 0; set < look.uv_sets; ++set) {
        const aiVector3D& uv = mesh.mTextureCoords[set][v];
        look.uv.push_back(finite(static_cast<float>(uv.x)));
        look.uv.push_back(finite(1.0f - static_cast<float>(uv.y)));
      }
}

SortedJson SceneLook::texture(const aiMaterial& material, std::initializer_list<aiTextureType> kinds) {
  for (const aiTextureType kind : kinds) {
    aiString name;
    unsigned set = 0;
    if (material.GetTexture(kind, 0, &name, nullptr, &set) != aiReturn_SUCCESS || name.length == 0) continue;
    const auto at = image(name.C_Str());
    if (!at) continue;
    SortedJson texture = {{"source", *at}};
    const int u = wrap_of(material, kind, false), v = wrap_of(material, kind, true);
    if (u != kRepeat || v != kRepeat) {
      texture["sampler"] = out_.materials.samplers.size();
      out_.materials.samplers.push_back({{"wrapS", u}, {"wrapT", v}});
    }
    SortedJson reference = {{"index", out_.materials.textures.size()}};
    if (set > 0 && set < AI_MAX_NUMBER_OF_TEXTURECOORDS) reference["texCoord"] = set;
    out_.materials.textures.push_back(std::move(texture));
    return reference;
  }
  return {};
}

std::optional<std::size_t> SceneLook::image(const std::string& name) {
  if (const auto known = images_.find(name); known != images_.end()) return known->second;
  std::optional<std::size_t>& at = images_[name];
  LookImage image{std::filesystem::path(name).filename().string(), {}, bytes_of(name)};
  image.mime_type = image_type(image.bytes);
  if (is_core_image(image.mime_type)) {
    at = out_.materials.images.size();
    out_.materials.images.push_back(std::move(image));
    return at;
  }
  out_.warnings.push_back({"image-left-out", name,
                           engine::message("The garment's image '", name,
                                           image.bytes.empty() ? "' is not there." : "' is no PNG or JPEG."),
                           "Put it where the material names it, as PNG or JPEG."});
  return at;
}

std::string SceneLook::bytes_of(const std::string& name) const {
  if (const aiTexture* inside = scene_.GetEmbeddedTexture(name.c_str())) {
    if (inside->mHeight != 0) return "";  // pixels without a file
    return {reinterpret_cast<const char*>(inside->pcData), inside->mWidth};
  }
  const std::filesystem::path file = find_image(name, folder_);
  return file.empty() ? "" : read_text(file);
}

void SceneLook::warn_of_lost_textures(const aiMaterial& material) {
  constexpr std::pair<aiTextureType, const char*> kLost[] = {{aiTextureType_HEIGHT, "height"},
                                                             {aiTextureType_OPACITY, "opacity"}};
  for (const auto& [kind, what] : kLost)
    if (material.GetTextureCount(kind) > 0)
      out_.warnings.push_back(
          {"image-left-out", material.GetName().C_Str(),
           engine::message("The material '", material.GetName().C_Str(), "' of the garment has an image of ",
                           what, ", which glTF cannot hold."),
           kind == aiTextureType_HEIGHT ? "Give a normal map (in MTL: norm)."
                                        : "Put opacity into the color's image."});
}

std::filesystem::path find_image(std::string name, const std::filesystem::path& folder) {
  std::ranges::replace(name, '\\', '/');
  const std::filesystem::path given(name);
  for (const std::filesystem::path& file : {folder / given, folder / given.filename()}) {
    std::error_code error;  // a device or a pipe has no end
    if (std::filesystem::is_regular_file(file, error)) return file;
  }
  return {};
}

}  // namespace bodice::io
