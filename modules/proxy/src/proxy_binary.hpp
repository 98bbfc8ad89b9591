#pragma once

#include <cstddef>
#include <span>

namespace bodice::proxy {

/// Whether the bytes begin as a binary proxy does.
bool is_binary_proxy(std::span<const std::byte> bytes);

}  // namespace bodice::proxy
