#include <bodice/proxy/proxy_file.hpp>

#include <cstdint>
#include <fstream>
#include <string>
#include <system_error>

#include <bodice/engine/write_file.hpp>

#include "file/proxy_binary.hpp"

namespace bodice::inline v0_1::proxy {
namespace {

namespace fs = std::filesystem;
using engine::Error;
using engine::ErrorCode;

// A larger file is not a proxy: the largest one in JSON takes four digits a texel, and less than 1 kB for an
// ellipsoid and its table.
constexpr std::uintmax_t kLargestFile = std::uintmax_t{1} << 29;
static_assert(4 * kMaxReliefTexels + 1000 * (kMaxEllipsoids + 1) < kLargestFile);

engine::Result<std::vector<std::byte>> read_file(const fs::path& file) {
  const Error missing{ErrorCode::kNotFound, "Cannot open the proxy " + file.string() + ".",
                      "Check the path, and that the file may be read."};
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return missing;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) return missing;
  if (size > kLargestFile)
    return Error{ErrorCode::kUnreadable, file.string() + " is over half a gigabyte: not a proxy.",
                 "Give a file that bodice fit or proxy::save() wrote."};
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  std::ifstream in(file, std::ios::binary);
  if (!in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)) && size > 0)
    return missing;
  return bytes;
}

}  // namespace

bool is_named_binary(const fs::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension == ".bodice";
}

engine::Result<void> save(const BodyProxy& proxy, const fs::path& file) {
  if (is_named_binary(file)) return engine::write_file(file, to_binary(proxy));
  return engine::write_file(file, to_json(proxy));
}

engine::Result<BodyProxy> load(const fs::path& file) {
  auto bytes = read_file(file);
  if (!bytes) return bytes.error();
  auto proxy = is_binary_proxy(*bytes)
                   ? from_binary(*bytes)
                   : from_json({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
  if (proxy) return proxy;
  Error error = proxy.error();
  error.message = file.string() + ": " + error.message;
  return error;
}

}  // namespace bodice::proxy
