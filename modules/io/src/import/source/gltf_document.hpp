// A glTF 2.0 document with its buffers: assimp drops step and cubic keys, normalized integers and all weights
// beyond four, so rigs are read here.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <bodice/engine/json.hpp>

namespace bodice::inline v0_1::io {

/// The numbers of an accessor: `components` of each of `count` elements, integers scaled where it is
/// normalized.
struct GltfNumbers {
  std::size_t count = 0, components = 0;
  std::vector<double> values;
};

class GltfDocument {
 public:
  /// Reads a .glb or .gltf file and the buffers it names. Empty where it is no readable document of
  /// version 2.
  static std::optional<GltfDocument> open(const std::filesystem::path& file);

  const engine::SortedJson& root() const { return json_; }
  /// Element `index` of one of the document's arrays ("nodes", "skins", ...); null where there is none.
  const engine::SortedJson& element(const char* array, std::size_t index) const;
  /// Empty where the accessor does not exist or points outside of its buffer.
  std::optional<GltfNumbers> numbers(std::size_t accessor) const;
  /// The bytes of a buffer view; none where it points outside of its buffer.
  std::string_view view_bytes(std::size_t view) const;

 private:
  struct Layout;

  bool read_dense(const engine::SortedJson& accessor, const Layout& layout, GltfNumbers& out) const;
  bool read_sparse(const engine::SortedJson& accessor, const Layout& layout, GltfNumbers& out) const;

  engine::SortedJson json_;
  std::vector<std::string> buffers_;
};

/// A whole number that is not negative under a key; empty where there is none.
std::optional<std::size_t> index_at(const engine::SortedJson& object, const char* key);
/// A text under a key, or an empty one.
std::string text_at(const engine::SortedJson& object, const char* key);
/// The array under a key, or an empty one.
const engine::SortedJson& array_at(const engine::SortedJson& object, const char* key);

}  // namespace bodice::io
