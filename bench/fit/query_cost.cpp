#include "query_cost.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <bench_references/subject.hpp>
#include <bench_support/stopwatch.hpp>
#include <bodice/collision/collider.hpp>

namespace fit_bench {

double query_ns(const bodice::proxy::BodyProxy& proxy, const bodice::geometry::TriMesh& skin) {
  using namespace bodice;
  constexpr std::size_t kParticles = 10000;
  constexpr int kRuns = 80;  // a run takes a fraction of a millisecond, so that some run is undisturbed
  constexpr double kBand_m = 0.030;
  const collision::Collider collider(proxy);
  bench::Cloud cloud =
      bench::local(bench::coherent(bench::near_skin(skin, kParticles, kBand_m, 7)), collider);
  std::vector<collision::Contact> contacts(cloud.size());
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < kRuns; ++run) {
    const bench::Stopwatch watch;
    collider.query({}, cloud.particles(), contacts);
    least = std::min(least, 1e6 * watch.cpu_ms());
  }
  return least / static_cast<double>(cloud.size());
}

}  // namespace fit_bench
