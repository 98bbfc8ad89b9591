// Colliders in the files of engines.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <bodice/colliders/plain_shape.hpp>
#include <bodice/engine/result.hpp>

namespace bodice::inline v0_1::colliders {

/// A form that some engine reads. README.md has the axes and units of each.
enum class Format : std::uint8_t { kUnity, kUnreal, kGodot, kVrm, kMujoco, kSdformat, kConvex };

inline constexpr int kFormatCount = 7;

/// What a format is called and what it can hold.
struct FormatFacts {
  std::string_view name;       ///< "unity", ...
  std::string_view extension;  ///< ".json", ...
  ShapeKind richest = ShapeKind::kCapsule;
  bool takes_ellipsoids = false;  ///< in place of plain shapes
  bool needs_rig = false;
  std::string_view other_extension = "";  ///< of a second form of the same, if there is one
};

/// The facts of a format.
const FormatFacts& facts(Format format);
/// The format of a name, such as "unity"; nothing if no format has it.
std::optional<Format> format_from_name(std::string_view text);

/// The text of a file. `shapes` is not read where the format takes ellipsoids. Fails with kInvalidArgument
/// where the format needs a rig and the proxy is bound to none, or cannot hold a shape. For kConvex it is
/// empty: convex_pieces.hpp makes those files.
engine::Result<std::string> text_of(Format format, const proxy::BodyProxy& proxy,
                                    std::span<const PlainShape> shapes);

}  // namespace bodice::colliders
