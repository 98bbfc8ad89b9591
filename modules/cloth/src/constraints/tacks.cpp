#include "constraints/tacks.hpp"

#include <cmath>

#include "base/tolerances.hpp"

namespace bodice::inline v0_1::cloth {

std::vector<Thread> make_threads(std::span<const Tack> tacks, std::span<const Index> particle_of_vertex,
                                 std::span<const Vec3> particles) {
  std::vector<Thread> threads;
  for (const Tack& tack : tacks) {
    if (tack.a >= particle_of_vertex.size() || tack.b >= particle_of_vertex.size()) continue;
    const Index a = particle_of_vertex[tack.a], b = particle_of_vertex[tack.b];
    if (a == b || a == geometry::kNoIndex || b == geometry::kNoIndex) continue;
    threads.push_back({a, b, static_cast<float>((particles[a] - particles[b]).norm())});
  }
  return threads;
}

void solve_threads(std::span<const Thread> threads, std::span<Point> points) {
  for (const Thread& thread : threads) {
    Point &a = points[thread.a], &b = points[thread.b];
    const Float4 from_a = xyz(load(b) - load(a));
    const float length = std::sqrt(from_a[0] * from_a[0] + from_a[1] * from_a[1] + from_a[2] * from_a[2]);
    if (!(length > thread.longest_m)) continue;
    const float share = (length - thread.longest_m) / (length * (a.weight + b.weight + kTinyWeight));
    store(a, load(a) + (share * a.weight) * from_a);
    store(b, load(b) - (share * b.weight) * from_a);
  }
}

}  // namespace bodice::cloth
