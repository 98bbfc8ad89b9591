// The words that the JSON writer and reader share.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace bodice::proxy {

inline constexpr std::string_view kJsonFormat = "bodice-proxy";
inline constexpr int kJsonVersion = 2;
inline constexpr std::array<std::string_view, 3> kAxisNames = {"x", "y", "z"};
inline constexpr std::string_view kHexDigits = "0123456789abcdef";

/// 16 lower-case hexadecimal digits: JSON numbers do not hold 64 bits everywhere.
inline std::string hex64(std::uint64_t value) {
  std::string text(16, '0');
  for (int i = 0; i < 16; ++i) text[15 - i] = kHexDigits[(value >> (4 * i)) & 15];
  return text;
}

}  // namespace bodice::proxy
