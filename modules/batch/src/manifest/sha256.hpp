// SHA-256, by which results are named: `sha256sum` gives the same value of a file.
// Based on: National Institute of Standards and Technology. Secure Hash Standard (FIPS PUB 180-4). 2015.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace bodice::inline v0_1::batch {

/// The hash of the bytes that are added to it, in order.
class Sha256 {
 public:
  void add(std::span<const std::byte> bytes);
  void add(std::string_view text) { add(std::as_bytes(std::span(text.data(), text.size()))); }
  /// Ends the message. Nothing may be added after it.
  std::array<std::uint8_t, 32> finish();

 private:
  void take_block(const std::byte* block);
  std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<std::byte, 64> block_ = {};
  std::size_t filled_ = 0;
  std::uint64_t bytes_ = 0;
};

/// All 64 hexadecimal digits.
std::string hex(const std::array<std::uint8_t, 32>& hash);

}  // namespace bodice::batch
