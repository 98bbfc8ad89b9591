#include "contender.hpp"

#include <algorithm>
#include <limits>
#include <memory>

#include <Eigen/Geometry>

#include <bench_references/peers.hpp>
#include <bench_support/stopwatch.hpp>

namespace tradeoff {
namespace {

using namespace bodice;
using collision::Collider;

/// A proxy with particles and contacts. It has no workspace: the same particles are queried repeatedly, so
/// that a candidate cache would gain more than in a motion.
struct Queries {
  Collider collider, moving;
  std::vector<geometry::Ellipsoid> shapes;
  bench::Cloud start, moved;
  std::vector<collision::Contact> contacts;
  collision::QueryOptions options;

  Queries(const proxy::BodyProxy& proxy, const bench::Cloud& particles, collision::Accuracy accuracy)
      : collider(proxy),
        moving(proxy),
        start(bench::local(particles, collider)),
        moved(start),
        contacts(start.size()),
        options{.accuracy = accuracy} {
    for (const auto& e : proxy.ellipsoids()) shapes.push_back(e.shape);
  }

  void query() { collider.query({}, start.particles(), contacts, options); }
  void respond() {
    moved = start;
    collider.resolve({}, moved.particles(), {});
  }
  void turn() {
    const geometry::Mat3 rotation = Eigen::AngleAxisd(0.001, geometry::Vec3::UnitY()).toRotationMatrix();
    for (auto& e : shapes) e.center = rotation * e.center, e.axes = rotation * e.axes;
    moving.move_to(shapes, 1.0 / 60.0);
  }
};

}  // namespace

double least_us(const std::function<void()>& work, int batch) {
  constexpr int kRepeats = 5;
  double least = std::numeric_limits<double>::infinity();
  for (int r = 0; r < kRepeats; ++r) {
    const bench::Stopwatch watch;
    for (int i = 0; i < batch; ++i) work();
    least = std::min(least, 1e3 * watch.cpu_ms() / batch);
  }
  return least;
}

double fit_ms(const fitting::FitResult& fit) {
  double ms = 0.0;
  for (const engine::StageTime& stage : fit.stages)
    if (stage.name != "measure" && stage.name != "distance") ms += stage.ms;
  return ms;
}

Contender of_proxy(const Subject& subject, const fitting::FitResult& fit, std::string setting,
                   collision::Accuracy accuracy) {
  const bool exact = accuracy == collision::Accuracy::kExact;
  const auto queries = std::make_shared<Queries>(fit.proxy, subject.particles, accuracy);
  Contender c;
  c.kind = std::string(proxy::name(fit.proxy.tier())) + (exact ? "" : " to first order");
  c.setting = std::move(setting);
  c.ours = true;
  c.size = static_cast<double>(fit.proxy.ellipsoids().size());
  c.bytes = static_cast<double>(fit.proxy.bytes());
  c.prepare_ms = fit_ms(fit);
  c.update_us = least_us([&] { queries->turn(); });
  c.particles = subject.particles.size();
  c.query = [queries] { queries->query(); };
  if (exact) c.respond = [queries] { queries->respond(); };
  c.distances_m = [queries] {
    queries->query();
    std::vector<float> found;
    for (const collision::Contact& contact : queries->contacts) found.push_back(contact.signed_distance);
    return found;
  };
  return c;
}

std::vector<Cost> time_all(const std::vector<Contender>& contenders, int rounds) {
  const double inf = std::numeric_limits<double>::infinity();
  std::vector<Cost> costs(contenders.size(), Cost{inf, inf});
  const auto measure = [](const std::function<void()>& work, std::size_t particles, double& least) {
    work();  // the contender before has filled the caches with its own data
    const bench::Stopwatch watch;
    work();
    least = std::min(least, 1e6 * watch.cpu_ms() / static_cast<double>(particles));
  };
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      measure(contenders[i].query, contenders[i].particles, costs[i].query_ns);
      if (contenders[i].respond)
        measure(contenders[i].respond, contenders[i].particles, costs[i].response_ns);
    }
  for (std::size_t i = 0; i < contenders.size(); ++i)
    if (!contenders[i].respond) costs[i].response_ns = 0.0;
  return costs;
}

}  // namespace tradeoff
