// Checks before any parser runs, and the parts of text formats that assimp does not pass on.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <bodice/engine/result.hpp>
#include <bodice/geometry/frame.hpp>

namespace bodice::inline v0_1::io {

/// Fails with one sentence if the file is missing, no regular file, empty or inaccessible, or has no whole
/// PLY header where it is PLY.
engine::Result<void> check_readable(const std::filesystem::path& file);

/// The whole file. Empty on failure.
std::string read_text(const std::filesystem::path& file);

/// The content of a Collada document's <asset>; a member is absent if the document lacks it.
struct ColladaAsset {
  std::optional<double> meters_per_unit;
  std::optional<geometry::Axis> up;
};
ColladaAsset parse_collada_asset(std::string_view document);

/// An OBJ text with its vertices moved to the origin, so that single precision keeps their digits.
struct MovedObj {
  std::string text;
  geometry::Vec3 offset;  ///< add it to every position to undo the move
};
/// Moves the vertices of an OBJ text; returns nothing if they are near enough to the origin for their size.
std::optional<MovedObj> move_to_origin(std::string_view obj);

}  // namespace bodice::io
