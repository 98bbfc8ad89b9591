// Numbers as text in files: the same bytes in any locale.
#pragma once

#include <cstdint>
#include <string>

#include <bodice/engine/version.hpp>

namespace bodice::inline v0_1::engine {

/// Appends what printf("%.*g") writes in the C locale. It reads back as the same float from 9 digits on, and
/// as the same double from 17 on. Precondition: 1 to 17 digits.
void append_number(std::string& text, double value, int digits);

/// The value as 16 lower-case hexadecimal digits. Hashes are written so, because JSON numbers do not hold 64
/// bits everywhere.
std::string hex64(std::uint64_t value);

}  // namespace bodice::engine
