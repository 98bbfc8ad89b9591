#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include <bodice/engine/result.hpp>

namespace bodice::inline v0_1::io {

/// Most pixels that a picture may have along one side.
inline constexpr int kLargestSide = 16384;

/// An image in 8-bit sRGB, row-major from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 x width x height
};

/// Encodes the image as PNG; the result is empty if libpng fails.
std::vector<std::byte> encode_png(const Image& image);

/// Writes the image; the file appears whole or not at all. Fails with kWriteFailed.
engine::Result<void> write_png(const Image& image, const std::filesystem::path& file);

}  // namespace bodice::io
