#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bodice::io {

/// 8-bit sRGB, row-major from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 x width x height
};

/// The image as a PNG file's bytes; empty where libpng refuses.
std::vector<std::byte> encode_png(const Image& image);

}  // namespace bodice::io
