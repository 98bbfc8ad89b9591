#include <nlohmann/json.hpp>

#include <bodice/io/import.hpp>

#include "import/source/file_format.hpp"
#include "import/source/gltf_buffers.hpp"
#include "import/source/gltf_document.hpp"
#include "import/source/input_file.hpp"

namespace bodice::io {

std::vector<std::filesystem::path> files_beside(const std::filesystem::path& file) {
  const Format format = format_of(file);
  if (format != Format::kGltf && format != Format::kGlb) return {};
  const nlohmann::json document = nlohmann::json::parse(split_glb(read_text(file)).json, nullptr, false);
  std::vector<std::filesystem::path> files;
  for (const nlohmann::json& buffer : array_at(document, "buffers")) {
    const std::string uri = text_at(buffer, "uri");
    if (uri.empty()) continue;  // the binary chunk of a GLB
    if (auto beside = file_of_uri(uri, file.parent_path())) files.push_back(std::move(*beside));
  }
  return files;
}

}  // namespace bodice::io
