#include "png.hpp"

#include <cstring>

#include <png.h>
#include <bodice/engine/write_file.hpp>

namespace bodice::inline v0_1::io {

std::vector<std::byte> encode_png(const Image& image) {
  png_image header;
  std::memset(&header, 0, sizeof header);
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::vector<std::byte> bytes(size);
  if (!png_image_write_to_memory(&header, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr)) return {};
  bytes.resize(size);
  return bytes;
}

engine::Result<void> write_png(const Image& image, const std::filesystem::path& file) {
  const std::vector<std::byte> png = encode_png(image);
  if (png.empty())
    return engine::Error{engine::ErrorCode::kWriteFailed,
                         "'" + file.string() + "' could not be encoded as PNG.", "Use a smaller picture."};
  return engine::write_file(file, png);
}

}  // namespace bodice::io
