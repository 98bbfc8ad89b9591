// Bytes as text, for files that hold other files.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include <bodice/engine/version.hpp>

namespace bodice::inline v0_1::engine {

/// Based on: Josefsson. RFC 4648. 2006. - section 4, with padding.
std::string base64(std::span<const std::byte> bytes);

}  // namespace bodice::engine
