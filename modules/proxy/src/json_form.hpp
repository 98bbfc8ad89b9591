// The keys that the JSON writer and reader share.
#pragma once

#include <array>
#include <string_view>

namespace bodice::proxy {

inline constexpr std::string_view kJsonFormat = "bodice-proxy";
inline constexpr int kJsonVersion = 2;
inline constexpr std::array<std::string_view, 3> kAxisNames = {"x", "y", "z"};
inline constexpr std::string_view kHexDigits = "0123456789abcdef";

}  // namespace bodice::proxy
