// Particles where the caller has them: structures or arrays, floats or doubles, in the world or elsewhere.
#pragma once

#include <cstddef>
#include <cstdint>

#include <bodice/engine/version.hpp>

namespace bodice::inline v0_1::collision {

/// Vectors of three numbers in memory of the caller, `stride` bytes apart. Nothing needs alignment.
struct StridedVectors {
  std::byte *x = nullptr, *y = nullptr, *z = nullptr;  ///< numbers of the first vector; null: there are none
  std::ptrdiff_t stride = 0;                           ///< bytes from one vector to the next, may be negative
  bool is_double = false;                              ///< else float

  bool present() const { return x && y && z; }
};

/// Particles, #P, that queries and responses read and write where they are, a batch at a time: no array of
/// them is copied. A response writes the numbers alone that it changes; all others keep their bits.
struct StridedParticles {
  std::size_t count = 0;
  /// #P: which vectors belong to a particle. With one twice, only a context without workers may resolve them.
  /// Null: particle i has vectors i.
  const std::uint32_t* element = nullptr;
  StridedVectors position;  ///< meters, in/out
  StridedVectors velocity;  ///< meters a second, in/out; may be absent
  StridedVectors safe;      ///< meters, last known positions outside the body; may be absent
  /// Where the local frame begins in the coordinates of `position` and `safe`, meters: Collider::origin() for
  /// coordinates of the world.
  double origin[3] = {0.0, 0.0, 0.0};
  /// Whether a query's contacts are in the coordinates of `position`, too, and not in the local frame.
  bool shift_contacts = false;
};

}  // namespace bodice::collision
