// Crossings of cloth with cloth on a body that walks: those where the posed skin leaves room for two layers,
// and those where it does not.
#pragma once

#include <string>
#include <vector>

#include "causes.hpp"

namespace bench {

/// Pairs of triangles that cross in one kept frame.
struct Crossed {
  std::size_t with_room = 0, without_room = 0;
  /// Crossings with room of which either triangle crossed without room in an earlier frame.
  std::size_t pressed_before = 0;
};

/// The crossings of each kept frame.
std::vector<Crossed> find_crossed(const bodice::engine::Context& context, const Judged& judged);

/// The most of each kind in any frame after the first ten, and the last frame. `pressed_before` is that of
/// the frame with the most that have room.
struct CrossedSpan {
  Crossed worst, end;
};

CrossedSpan span_of(const std::vector<Crossed>& frames);

/// Prints where the crossings of a frame are: pairs of parts of the body that the triangles lay on at the
/// start, those with room first.
void print_crossed(const bodice::engine::Context& context, const Judged& judged, std::size_t frame);

}  // namespace bench
