// The keys that the JSON writer and reader share.
#pragma once

#include <array>
#include <string_view>

namespace bodice::inline v0_1::proxy {

inline constexpr std::string_view kJsonFormat = "bodice-proxy";
/// Proxies without a binding are written in version 2, so that earlier builds read them.
inline constexpr int kJsonVersion = 2, kBoundJsonVersion = 3;
inline constexpr std::array<std::string_view, 3> kAxisNames = {"x", "y", "z"};

}  // namespace bodice::proxy
