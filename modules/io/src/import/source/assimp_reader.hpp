// assimp with one reader: that of the file's format.
#pragma once

#include <filesystem>
#include <string>

#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include "import/source/file_format.hpp"

namespace bodice::inline v0_1::io {

/// assimp chooses among some fifty readers by a file's name, and several of them crash on files that are not
/// theirs. Here all but the wanted one are removed before a file is opened.
class AssimpReader {
 public:
  /// `format` is one of the mesh formats.
  explicit AssimpReader(Format format);

  Format format() const { return format_; }
  Assimp::Importer& importer() { return importer_; }

  /// The content of a file, whatever its name; null on failure. The scene lives as long as this reader.
  const aiScene* read(const std::filesystem::path& file);
  /// The same for text in memory, which names no other file.
  const aiScene* read_text(const std::string& text);

 private:
  Format format_;
  Assimp::Importer importer_;
};

}  // namespace bodice::io
