// The format of a mesh file by its content. Names are often wrong, and each of assimp's many readers would
// take what its extension promises, so that no file reaches the reader of another format.
#pragma once

#include <filesystem>
#include <string_view>

namespace bodice::inline v0_1::io {

enum class Format { kUnknown, kObj, kPly, kStl, kGltf, kGlb, kFbx, kCollada, kColladaArchive, kBvh };

/// Looks at the beginning, the end and the size of a file. kUnknown: it has none of these formats, or cannot
/// be opened. glTF is version 2 alone,
/// and kGlb its binary form.
Format format_of(const std::filesystem::path& file);

/// The usual extension of a format, without the dot; empty for kUnknown.
std::string_view extension_of(Format format);

/// The name that assimp gives to its reader of a format; empty where assimp is not to read it.
std::string_view reader_of(Format format);

}  // namespace bodice::io
