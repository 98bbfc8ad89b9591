// The format of a mesh file by its content. Names are often wrong, and each of assimp's many readers would
// take what its extension promises, so that no file reaches the reader of another format.
#pragma once

#include <filesystem>
#include <string_view>

namespace bodice::inline v0_1::io {

enum class Format { kUnknown, kObj, kPly, kStl, kGltf, kGlb, kFbx, kCollada, kColladaArchive, kBvh };

/// Looks at the beginning, the end and the size of a file. kUnknown: it has none of these formats, or cannot
/// be opened. glTF is version 2 alone, and kGlb its binary form.
Format format_of(const std::filesystem::path& file);

/// What is known of a format beside its mark.
struct FormatTraits {
  Format format = Format::kUnknown;
  std::string_view extension;  ///< the usual one, without the dot; empty for kUnknown
  std::string_view reader;     ///< assimp's name of its reader; empty where assimp is not to read the format
  /// Whether that reader ends without a crash on every damaged file seen so far.
  bool survives_damage = false;
  bool splits_vertices = false;  ///< whether that reader makes a vertex of each corner of a triangle
  bool has_materials = true;     ///< whether a file of the format can have materials
};

/// The traits of a format; those of kUnknown for one without a row.
const FormatTraits& traits_of(Format format);

}  // namespace bodice::io
