#include "output/query_speed.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/random.hpp>
#include <bodice/fitting/cost_model.hpp>
#include <bodice/geometry/sampling.hpp>

namespace bodice::inline v0_1::cli {
namespace {

using geometry::Vec3;

constexpr std::size_t kParticles = 10000;
constexpr double kBand_m = 0.030;
constexpr int kRuns = 100;  // each takes a fraction of a millisecond, and at least one is undisturbed

/// Points near the skin, in an order that keeps neighbors close in memory, like a garment's particles.
std::vector<Vec3> particles_near(const geometry::TriMesh& skin) {
  const engine::Random random(7);
  std::vector<Vec3> points;
  for (const auto& at : geometry::sample_surface(skin, kParticles, 7)) {
    const double offset = kBand_m * (2.0 * random.uniform_at(points.size()) - 1.0);
    points.push_back(at.point + offset * geometry::area_vector(skin, at.triangle).stableNormalized());
  }
  constexpr double kCell_m = 0.04;
  const auto cell = [](const Vec3& p) {
    return std::array{std::floor(p.y() / kCell_m), std::floor(p.x() / kCell_m), std::floor(p.z() / kCell_m)};
  };
  std::ranges::stable_sort(points, {}, cell);
  return points;
}

constexpr double kApart = 1.2;  // factor by which bodies differ from the cost model on its machine

/// Whether another budget gives another proxy. It does not where the number of ellipsoids is at its bounds,
/// now or with the advised budget.
bool is_useful(double advised_us, double budget_us, const std::string& tier, const proxy::BodyProxy& proxy) {
  constexpr int kFewest = 16;  // the least number that a budget gives: fewer take as long
  const double predicted_us =
      fitting::predicted_frame_us(proxy.tier(), static_cast<int>(proxy.ellipsoids().size()));
  const proxy::Tier fastest = tier.empty() ? proxy::Tier::kTight : proxy.tier();
  return predicted_us < kApart * budget_us && budget_us < kApart * predicted_us &&
         advised_us >= fitting::predicted_frame_us(fastest, kFewest);
}

}  // namespace

double query_us(const proxy::BodyProxy& proxy, const geometry::TriMesh& skin) {
  const collision::Collider collider(proxy);
  std::vector<float> x, y, z;
  for (const Vec3& point : particles_near(skin)) {
    const Eigen::Vector3f local = (point - collider.origin()).cast<float>();
    x.push_back(local.x()), y.push_back(local.y()), z.push_back(local.z());
  }
  std::vector<collision::Contact> contacts(x.size());
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < kRuns; ++run) {
    const auto start = std::chrono::steady_clock::now();
    collider.query({}, {.count = x.size(), .x = x.data(), .y = y.data(), .z = z.data()}, contacts);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    least = std::min(least, took.count());
  }
  return least;
}

void print_speed(const std::string& tier, double budget_us, const proxy::BodyProxy& proxy,
                 const geometry::TriMesh& skin) {
  const double us = query_us(proxy, skin);
  std::printf("speed       10,000 particles near the skin take %.0f us here, on one thread (budget %g)", us,
              budget_us);
  const double advised_us = budget_us * budget_us / us;
  if ((us > kApart * budget_us || kApart * us < budget_us) && is_useful(advised_us, budget_us, tier, proxy))
    std::printf("; if this machine is idle, --budget-us %.0f gives that time here", advised_us);
  std::putchar('\n');
}

}  // namespace bodice::cli
