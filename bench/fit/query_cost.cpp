#include "query_cost.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <bench_support/stopwatch.hpp>
#include <bodice/collision/collider.hpp>
#include <bodice/engine/random.hpp>
#include <bodice/geometry/sampling.hpp>

namespace fit_bench {

double query_ns(const bodice::proxy::BodyProxy& proxy, const bodice::geometry::TriMesh& skin) {
  using namespace bodice;
  constexpr std::size_t kParticles = 20000;
  constexpr int kRuns = 40;  // a run takes half a millisecond: one of them is undisturbed
  constexpr double kBand_m = 0.030;
  const collision::Collider collider(proxy);
  const engine::Random random(7);
  std::vector<float> x, y, z;
  const auto surface = geometry::sample_surface(skin, kParticles, 7);
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const double offset = kBand_m * (2.0 * random.uniform_at(i) - 1.0);
    const geometry::Vec3 normal = geometry::area_vector(skin, surface[i].triangle).stableNormalized();
    const geometry::Vec3 p = surface[i].point + offset * normal - collider.origin();
    x.push_back(static_cast<float>(p.x()));
    y.push_back(static_cast<float>(p.y()));
    z.push_back(static_cast<float>(p.z()));
  }
  collision::Particles particles;
  particles.count = x.size();
  particles.x = x.data();
  particles.y = y.data();
  particles.z = z.data();
  std::vector<collision::Contact> contacts(x.size());
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < kRuns; ++run) {
    const bench::Stopwatch watch;
    collider.query({}, particles, contacts);
    least = std::min(least, 1e6 * watch.cpu_ms());
  }
  return least / static_cast<double>(x.size());
}

}  // namespace fit_bench
