// Counter-based random numbers: the k-th value of a stream is a pure function of (seed, stream, k), so
// parallel code draws the same numbers whatever the order.
// Based on: Guy L. Steele, Doug Lea, Christine H. Flood. Fast Splittable Pseudorandom Number Generators.
// 2014. (the finalizer of SplitMix64, with Stafford's mixing constants)
#pragma once

#include <cmath>
#include <cstdint>

#include <bodice/engine/version.hpp>

namespace bodice::inline v0_1::engine {

/// A bijection of 64 bits. A changed bit of z changes about half of the bits of the result.
constexpr std::uint64_t mix64(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
  return z ^ (z >> 31);
}

/// A stream of random numbers, given by a seed and a stream number.
class Random {
 public:
  explicit constexpr Random(std::uint64_t seed, std::uint64_t stream = 0)
      : key_(mix64(seed + 0x9E3779B97F4A7C15ull) ^ mix64(stream * 0xD1342543DE82EF95ull + 1)) {}

  /// The k-th 64 random bits of this stream, without advancing it.
  constexpr std::uint64_t bits_at(std::uint64_t k) const { return mix64(key_ + k * 0x9E3779B97F4A7C15ull); }
  /// The k-th value in [0, 1), without advancing the stream.
  constexpr double uniform_at(std::uint64_t k) const {
    return static_cast<double>(bits_at(k) >> 11) * 0x1.0p-53;
  }

  /// The next 64 random bits.
  constexpr std::uint64_t bits() { return bits_at(next_++); }
  /// The next value in [0, 1), and in [low, high).
  constexpr double uniform() { return uniform_at(next_++); }
  constexpr double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// An integer in [0, n), n > 0, with bias below n / 2^53.
  constexpr std::uint64_t below(std::uint64_t n) {
    return static_cast<std::uint64_t>(uniform() * static_cast<double>(n));
  }
  /// A standard normal number (Box-Muller; consumes two values).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(6.283185307179586 * uniform());
  }

 private:
  std::uint64_t key_;
  std::uint64_t next_ = 0;
};

}  // namespace bodice::engine
