#include <cmath>
#include <memory>

#include <bench_references/capsules.hpp>
#include <bench_references/peers.hpp>
#include <bench_support/stopwatch.hpp>
#include "contender.hpp"

namespace tradeoff {
namespace {

using bench::Capsule;

Contender of_peer(const Subject& subject, std::string kind, std::string setting, bench::Peer peer) {
  const auto shared = std::make_shared<bench::Peer>(std::move(peer));
  const auto found = std::make_shared<std::vector<float>>(subject.particles.size());
  const bench::Cloud* const particles = &subject.particles;
  Contender c;
  c.kind = std::move(kind);
  c.setting = std::move(setting);
  c.bytes = shared->bytes;
  c.prepare_ms = shared->build_ms;
  c.update_us = 1e3 * shared->build_ms;  // the peer is built anew for a moving body
  c.particles = particles->size();
  c.query = [=] { shared->query(*particles, *found); };
  c.distances_m = [=] {
    shared->query(*particles, *found);
    return *found;
  };
  return c;
}

/// Turns the capsules about the vertical by a small angle.
void turn(std::vector<Capsule>& capsules) {
  constexpr float kSine = 0.001f, kCosine = 0.9999995f;
  for (Capsule& c : capsules)
    for (float* p : {c.start, c.along}) {
      const float x = p[0], z = p[2];
      p[0] = kCosine * x + kSine * z, p[2] = kCosine * z - kSine * x;
    }
}

Contender of_capsules(const Subject& subject) {
  const bench::Stopwatch watch;
  const auto capsules = std::make_shared<std::vector<Capsule>>(
      bench::fit_capsules(subject.skin.input.skin, subject.skin.anatomy.part));
  const double build_ms = watch.cpu_ms();
  const auto count = static_cast<double>(capsules->size());
  bench::Peer peer;
  peer.build_ms = build_ms;
  peer.bytes = count * sizeof(Capsule);
  peer.query = [capsules](const bench::Cloud& cloud, std::span<float> distance_m) {
    bench::capsule_distances(*capsules, cloud, distance_m);
  };
  Contender c = of_peer(subject, "capsules", "one a part", std::move(peer));
  c.size = count;
  c.update_us = least_us(
      [moving = *capsules]() mutable { turn(moving); });  // capsules move with bones, like ellipsoids
  return c;
}

}  // namespace

std::vector<Contender> peers(const Subject& subject, const std::vector<double>& grid_cells_m) {
  constexpr double kReach_m = 0.031;
  std::vector<Contender> all;
  for (bench::Peer& peer : bench::embree_peers(subject.skin.input.skin, kReach_m)) {
    all.push_back(of_peer(subject, "Embree", "exact", std::move(peer)));
    all.back().has_sign = false;
  }
  for (const double cell_m : grid_cells_m)
    all.push_back(of_peer(subject, "grid", std::to_string(std::lround(1e3 * cell_m)) + " mm",
                          bench::grid_peer(subject.skin.input.skin, *subject.skin.distance, cell_m)));
  all.push_back(of_capsules(subject));
  return all;
}

}  // namespace tradeoff
