// The checks that come before any parser, and the parts of text formats that assimp does not hand on.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <bodice/engine/result.hpp>
#include <bodice/geometry/frame.hpp>

namespace bodice::io {

/// Formats that need care of our own, by file extension.
enum class Format { kOther, kObj, kCollada, kColladaArchive, kGltf, kFbx, kBvh };
Format format_of(const std::filesystem::path& file);

/// Fails with one sentence where there is nothing to parse: no such file, a directory, empty, no access, a
/// format whose reader is not safe.
engine::Result<void> check_readable(const std::filesystem::path& file);

/// The whole file. Empty on failure.
std::string read_text(const std::filesystem::path& file);

/// What a Collada document says in <asset>; absent where it is silent.
struct ColladaAsset {
  std::optional<double> meters_per_unit;
  std::optional<geometry::Axis> up;
};
ColladaAsset parse_collada_asset(std::string_view document);

/// An OBJ text whose vertices were moved, so that single precision keeps their digits.
struct MovedObj {
  std::string text;
  geometry::Vec3 offset;  ///< add it to every position to undo the move
};
/// Empty where the vertices are near enough to the origin for their size.
std::optional<MovedObj> move_to_origin(std::string_view obj);

}  // namespace bodice::io
