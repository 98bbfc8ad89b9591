
#include <bodice/engine/json.hpp>
#include <bodice/io/import.hpp>

#include "import/look/scene_look.hpp"
#include "import/source/file_format.hpp"
#include "import/source/gltf_buffers.hpp"
#include "import/source/gltf_document.hpp"
#include "import/source/input_file.hpp"
#include "import/source/obj_materials.hpp"

namespace bodice::inline v0_1::io {

namespace {

std::vector<std::filesystem::path> files_of_gltf(const std::filesystem::path& file) {
  const engine::SortedJson document = engine::SortedJson::parse_or_null(split_glb(read_text(file)).json);
  std::vector<std::filesystem::path> files;
  for (const char* list : {"buffers", "images"})
    for (const engine::SortedJson& item : array_at(document, list)) {
      const std::string uri = text_at(item, "uri");
      if (uri.empty()) continue;  // the binary chunk of a GLB
      if (auto beside = file_of_uri(uri, file.parent_path())) files.push_back(std::move(*beside));
    }
  return files;
}

std::vector<std::filesystem::path> files_of_obj(const std::filesystem::path& file) {
  std::vector<std::filesystem::path> files = material_libraries(file);
  const std::size_t libraries = files.size();
  for (std::size_t i = 0; i < libraries; ++i)
    for (const std::string& name : images_of_library(files[i])) {
      std::filesystem::path image = find_image(name, file.parent_path());
      files.push_back(image.empty() ? file.parent_path() / name : std::move(image));
    }
  return files;
}

}  // namespace

std::vector<std::filesystem::path> files_beside(const std::filesystem::path& file) {
  const Format format = format_of(file);
  if (format == Format::kObj) return files_of_obj(file);
  if (format == Format::kGltf || format == Format::kGlb) return files_of_gltf(file);
  return {};
}

}  // namespace bodice::io
