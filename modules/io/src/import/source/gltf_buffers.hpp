// Where the bytes of a glTF document come from: the chunks of a GLB, data URIs, files beside it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace bodice::inline v0_1::io {

/// A file taken apart: its JSON text, and the binary chunk of a GLB.
struct GltfText {
  std::string json, binary;
};
/// Text that is not a GLB is all JSON. Chunks beyond the end are cut.
GltfText split_glb(std::string file);

/// The file that a URI names, relative to `folder`. Empty where the URI holds its data itself.
std::optional<std::filesystem::path> file_of_uri(std::string_view uri, const std::filesystem::path& folder);

/// The bytes that a URI names: base64 data, or a file relative to `folder`. Empty where there are none.
std::string load_uri(std::string_view uri, const std::filesystem::path& folder);

}  // namespace bodice::io
