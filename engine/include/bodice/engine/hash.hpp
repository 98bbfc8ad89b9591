// A 64-bit hash of a sequence of plain values. It identifies proxies, and frames in determinism tests. It is
// not cryptographic.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

#include <bodice/engine/random.hpp>

namespace bodice::inline v0_1::engine {

/// Hashes the values that are added to it, in order.
class Hasher {
 public:
  /// Adds an integer to the sequence.
  void add(std::uint64_t value) { state_ = mix64(state_ ^ mix64(value + 0x9E3779B97F4A7C15ull)) + ++count_; }
  /// Hashes the bits, except that -0 counts as 0.
  void add(double value) { add(std::bit_cast<std::uint64_t>(value == 0.0 ? 0.0 : value)); }
  void add(float value) { add(std::uint64_t{std::bit_cast<std::uint32_t>(value == 0.0f ? 0.0f : value)}); }
  template <class T>
  requires std::is_integral_v<T> || std::is_enum_v<T>
  void add(T value) { add(static_cast<std::uint64_t>(value)); }
  /// Adds the number of values, and then each of them.
  template <class T>
  void add(std::span<const T> values) {
    add(static_cast<std::uint64_t>(values.size()));
    for (const T& value : values) add(value);
  }
  /// Adds the number of characters, and then each of them.
  void add(std::string_view text) { add(std::span<const char>(text.data(), text.size())); }

  /// The hash of the sequence up to here; more values may follow.
  std::uint64_t value() const { return mix64(state_ ^ count_); }

 private:
  std::uint64_t state_ = 0;
  std::uint64_t count_ = 0;
};

}  // namespace bodice::engine
