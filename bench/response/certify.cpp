// Certifies that no particle is inside after a response: millions of random particles in and around fitted
// bodies. Plain tiers are judged by the ellipsoids in double precision, relief by the proxy's own query. The
// paper's response is measured beside it.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/random.hpp>

#include "modes.hpp"
#include "subjects.hpp"

namespace bench {

using namespace bodice;
using geometry::Vec3;

namespace {

constexpr std::size_t kBatch = 100000;
constexpr double kReliefBar_m = 5e-5;

/// Counts over all judged particles.
struct Count {
  std::size_t particles = 0, inside = 0, wrong_side = 0;
  double deepest_m = 0.0;
  collision::ContactReport report;
};

/// Particles and their safe positions.
struct Batch {
  std::vector<float> x, y, z, sx, sy, sz;
  collision::Particles view(bool with_safe) {
    collision::Particles p{.count = x.size(), .x = x.data(), .y = y.data(), .z = z.data()};
    if (with_safe) p.safe_x = sx.data(), p.safe_y = sy.data(), p.safe_z = sz.data();
    return p;
  }
};

/// Random particles: half in the box, half in and around ellipsoids; safe positions up to 5 cm away.
Batch random_batch(const proxy::BodyProxy& proxy, const Vec3& origin, std::size_t count,
                   engine::Random& random) {
  Vec3 low = Vec3::Constant(1e9), high = -low;
  for (const auto& e : proxy.ellipsoids()) {
    const auto box = geometry::bounding_box(e.shape);
    low = low.cwiseMin(box.low), high = high.cwiseMax(box.high);
  }
  const auto in_cube = [&](double half) {
    const double a = random.uniform(-half, half), b = random.uniform(-half, half);
    return Vec3(a, b, random.uniform(-half, half));
  };
  Batch batch;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 p = 0.5 * (low + high) + (high - low).cwiseProduct(in_cube(0.55));
    if (i % 2 == 0) {
      const auto& e = proxy.ellipsoids()[random.below(proxy.ellipsoids().size())].shape;
      p = e.center + e.axes * e.radii.cwiseProduct(in_cube(1.0));
    }
    p -= origin;
    const Vec3 s = p + in_cube(0.05);
    batch.x.push_back(static_cast<float>(p.x()));
    batch.y.push_back(static_cast<float>(p.y()));
    batch.z.push_back(static_cast<float>(p.z()));
    batch.sx.push_back(static_cast<float>(s.x()));
    batch.sy.push_back(static_cast<float>(s.y()));
    batch.sz.push_back(static_cast<float>(s.z()));
  }
  return batch;
}

/// Depth of a particle below the proxy's surface, meters; zero or less outside.
double depth_m(const proxy::BodyProxy& proxy, const collision::Collider& collider, const float (&at)[3]) {
  if (!proxy.relief().empty()) return -double{collider.query(at).signed_distance};
  const Vec3 p = collider.origin() + Vec3(double{at[0]}, double{at[1]}, double{at[2]});
  double deepest = -1.0;
  for (const auto& e : proxy.ellipsoids())
    if (geometry::level(e.shape, p) < 1.0)
      deepest = std::max(deepest, proxy.margin_m() - geometry::closest_point(e.shape, p).signed_distance);
  return deepest;
}

Count certify(const proxy::BodyProxy& proxy, const collision::ResolveOptions& options, bool with_safe,
              std::size_t particles, std::uint64_t seed) {
  const collision::Collider collider(proxy);
  const double bar_m = proxy.relief().empty() ? 1e-6 * proxy.stature_m() : kReliefBar_m;
  engine::Random random(seed);
  Count count;
  while (count.particles < particles) {
    Batch batch =
        random_batch(proxy, collider.origin(), std::min(kBatch, particles - count.particles), random);
    // The judged response uses candidates that were cached half a millimeter away.
    collision::Workspace workspace;
    Batch before = batch;
    for (float& x : before.x) x += 5e-4f;
    collider.resolve({}, before.view(with_safe), options, workspace);
    count.report.add(collider.resolve({}, batch.view(with_safe), options, workspace));
    for (std::size_t i = 0; i < batch.x.size(); ++i) {
      const double depth = depth_m(proxy, collider, {batch.x[i], batch.y[i], batch.z[i]});
      count.inside += depth > bar_m;
      count.deepest_m = std::max(count.deepest_m, depth);
    }
    count.particles += batch.x.size();
  }
  return count;
}

/// A response that is certified, or measured beside those that are.
struct Mode {
  const char* name;
  collision::ResolveOptions options;
  bool from_safe = false;       ///< whether particles have safe positions
  bool has_to_be_clear = true;  ///< whether a particle that it leaves inside fails the bench
};

const Mode kModes[] = {{"closest point", {}},
                       {"closest point, 3 mm", {.thickness_m = 0.003f}},
                       {"closest point, from a safe position", {}, true},
                       {"paper", {.response = collision::Response::kPaper}, false, false}};

}  // namespace

bool certify_random(std::span<char*> arguments) {
  const auto total = static_cast<std::size_t>(arguments.empty() ? 1e6 : std::atof(arguments[0]));
  const auto seed = static_cast<std::uint64_t>(arguments.size() < 2 ? 77 : std::atoll(arguments[1]));
  std::size_t judged = 0, inside = 0;
  std::uint64_t unresolved = 0;
  const struct {
    const char* name;
    synth::Pose pose;
    std::uint64_t seed;
  } poses[] = {{"A", synth::Pose::kA, 0},
               {"arms down, another body", synth::Pose::kArmsDown, 3},
               {"sit, a third", synth::Pose::kSit, 5}};
  constexpr proxy::Tier kTiers[] = {proxy::Tier::kPaper, proxy::Tier::kSolid, proxy::Tier::kTight,
                                    proxy::Tier::kRelief};
  const auto certified = static_cast<std::size_t>(std::ranges::count_if(kModes, &Mode::has_to_be_clear));
  const std::size_t share = total / (std::size(kTiers) * std::size(poses) * certified);
  std::printf(
      "| tier | pose | response | particles | contacts | inside (bar 0) | deepest mm | pinched | fallbacks | "
      "wrong side | unresolved (bar 0) | exactly judged %% | rounds "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const proxy::Tier tier : kTiers)
    for (const auto& pose : poses) {
      const proxy::BodyProxy proxy = fit_body(pose.pose, pose.seed, tier);
      for (std::size_t m = 0; m < std::size(kModes); ++m) {
        const Mode& mode = kModes[m];
        const Count c = certify(proxy, mode.options, mode.from_safe, share, std::size(kModes) * seed + m);
        const auto u = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
        std::printf("| %s | %s | %s | %zu | %llu | %zu | %.4f | %llu | %llu | %llu | %llu | %.2f | %u |\n",
                    std::string(proxy::name(tier)).c_str(), pose.name, mode.name, c.particles,
                    u(c.report.contacts), c.inside, 1e3 * c.deepest_m, u(c.report.pinched),
                    u(c.report.fallbacks), u(c.report.wrong_side), u(c.report.unresolved),
                    100.0 * static_cast<double>(c.report.judged_exactly) / static_cast<double>(c.particles),
                    c.report.max_iterations);
        std::fflush(stdout);
        if (!mode.has_to_be_clear) continue;
        judged += c.particles;
        inside += c.inside;
        unresolved += c.report.unresolved;
      }
    }
  std::printf("without the paper's response, seed %llu: %zu particles, %zu inside, %llu unresolved (bar 0)\n",
              static_cast<unsigned long long>(seed), judged, inside,
              static_cast<unsigned long long>(unresolved));
  return inside == 0 && unresolved == 0;
}

}  // namespace bench
