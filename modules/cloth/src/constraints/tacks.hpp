// Tacks: threads between particles of different pieces of a garment. A thread limits the distance of its ends
// to that at the start.
#pragma once

#include <span>
#include <vector>

#include <bodice/cloth/solver.hpp>

#include "base/particles.hpp"

namespace bodice::inline v0_1::cloth {

/// A thread between two particles.
struct Thread {
  Index a = 0, b = 0;
  float longest_m = 0.0f;
};

/// The threads of all tacks that join two different particles. A tack of a vertex without a particle, or of
/// one particle with itself, is left out.
std::vector<Thread> make_threads(std::span<const Tack> tacks, std::span<const Index> particle_of_vertex,
                                 std::span<const Vec3> particles);

/// Pulls the ends of each thread together to its length, in order, by their weights.
void solve_threads(std::span<const Thread> threads, std::span<Point> points);

}  // namespace bodice::cloth
