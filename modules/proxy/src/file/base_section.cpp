#include "file/base_section.hpp"

#include <algorithm>
#include <array>

#include "bytes/bytes.hpp"

namespace bodice::inline v0_1::proxy {
namespace {

constexpr std::array<char, 8> kSectionMagic = {'B', 'O', 'D', 'I', 'C', 'E', 'B', 'P'};
constexpr std::size_t kEndBytes = 8 + kSectionMagic.size();  // length and magic

bool ends_with_magic(std::span<const std::byte> file) {
  return file.size() >= kEndBytes &&
         std::ranges::equal(kSectionMagic, file.last(kSectionMagic.size()),
                            [](char c, std::byte b) { return static_cast<std::byte>(c) == b; });
}

}  // namespace

std::span<const std::byte> base_section(std::span<const std::byte> file) {
  if (!ends_with_magic(file)) return {};
  const auto before = file.first(file.size() - kEndBytes);
  const std::uint64_t length = ByteReader(file.subspan(before.size())).get<std::uint64_t>();
  return length <= before.size() ? before.last(static_cast<std::size_t>(length)) : before.first(0);
}

std::span<const std::byte> without_base_section(std::span<const std::byte> file) {
  if (!ends_with_magic(file)) return file;
  return file.first(file.size() - kEndBytes - base_section(file).size());
}

void append_base_section(std::span<const std::byte> section, std::vector<std::byte>& file) {
  ByteWriter end;
  end.put(static_cast<std::uint64_t>(section.size()));
  for (const char c : kSectionMagic) end.put(static_cast<std::uint8_t>(c));
  file.insert(file.end(), section.begin(), section.end());
  const auto written = end.written();
  file.insert(file.end(), written.begin(), written.end());
}

}  // namespace bodice::proxy
