// The proxy grows from 89 to 4,096 ellipsoids: fits of the paper's tier, which uses more than the other tiers
// would, then balls. The particles stay the same. They are stored along a space-filling curve, in random
// order with a workspace, and in random order without one.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <stdexcept>
#include <vector>

#include <bench_references/subject.hpp>
#include <bench_support/stopwatch.hpp>
#include "counts.hpp"
#include "rows.hpp"

namespace bench {

using bodice::collision::Collider;
using bodice::collision::Contact;
using bodice::collision::Workspace;
using bodice::geometry::Vec3;
using bodice::proxy::BodyProxy;

namespace {

constexpr std::size_t kFitted = 1000;  // the largest number that a fit makes sense for
constexpr double kBall_m = 0.02;

/// A proxy of balls around points of the skin.
BodyProxy balls(const bodice::geometry::TriMesh& mesh, double stature_m, std::size_t count) {
  const Cloud centers = near_skin(mesh, count, 0.0, 7);
  BodyProxy::Data data{.tier = bodice::proxy::Tier::kSolid, .stature_m = stature_m};
  for (std::size_t i = 0; i < count; ++i) {
    bodice::geometry::Ellipsoid ball;
    ball.center = centers.at(i);
    ball.radii.setConstant(kBall_m);
    data.ellipsoids.push_back({ball, {}});
  }
  auto proxy = BodyProxy::make(data);
  if (!proxy.ok()) throw std::runtime_error(proxy.error().sentence());
  return std::move(proxy).value();
}

double least_ns(int repeats, std::size_t particles, const std::function<void()>& prepare,
                const std::function<void()>& work) {
  double least = std::numeric_limits<double>::infinity();
  for (int r = 0; r <= repeats; ++r) {
    prepare();
    const Stopwatch watch;
    work();
    if (r > 0) least = std::min(least, watch.cpu_ms());
  }
  return 1e6 * least / static_cast<double>(particles);
}

void print_row(const BodyProxy& proxy, const Cloud& ordered, const Cloud& shuffled, int repeats) {
  const Collider collider(proxy);
  const std::size_t count = ordered.size();
  std::vector<Contact> contacts(count);
  std::printf("| %zu |", collider.size());
  for (const bool response : {false, true})
    for (int order = 0; order < 3; ++order) {
      const Cloud start = local(order == 0 ? ordered : shuffled, collider);
      Cloud now = start;
      Workspace kept;
      const auto query = [&] {
        order == 1 ? collider.query({}, now.particles(), contacts, kept)
                   : collider.query({}, now.particles(), contacts);
      };
      const auto resolve = [&] {
        order == 1 ? collider.resolve({}, now.particles(), {}, kept)
                   : collider.resolve({}, now.particles(), {});
      };
      const auto again = [&] { now = start; };
      std::printf(" %.0f |", response ? least_ns(repeats, count, again, resolve)
                                      : least_ns(repeats, count, again, query));
    }
  std::puts("");
  std::fflush(stdout);
}

}  // namespace

void grow_counts(std::size_t particles, int repeats) {
  const auto body = make_subject(8850);
  const bodice::geometry::MeshDistance skin({}, body.mesh);
  const Cloud shuffled = near_skin(body.mesh, particles, kBand_m, 1), ordered = coherent(shuffled);
  std::puts(
      "| ellipsoids | query: coherent | random, order kept | random | response: coherent | random, order "
      "kept "
      "| random |\n|---|---|---|---|---|---|---|");
  for (const std::size_t count : {89u, 240u, 400u, 1000u, 4096u})
    print_row(count <= kFitted
                  ? fit_subject(body, skin, bodice::proxy::Tier::kPaper, static_cast<int>(count), 2.0)
                  : balls(body.mesh, body.stature_m, count),
              ordered, shuffled, repeats);
}

}  // namespace bench
