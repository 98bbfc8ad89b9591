#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/noise.hpp>

#include "repair/quadric.hpp"
#include "repair/rings.hpp"

namespace bodice::inline v0_1::geometry {
namespace {

/// No ring is farther than this fraction of the longest side, 10 cm of a person.
constexpr double kFarthest = 0.06;
/// A vertex that is as certain as this fraction of the longest side, .2 mm of a person, needs no more rings.
constexpr double kCertain = 0.00012;
/// Each fit gives a range of this many of its standard deviations; the ranges of fits that agree meet.
constexpr double kAgree = 1.7;
/// A quadric follows its points where these deviate by less than this, in variances of the noise, and by less
/// than so many standard deviations of that estimate.
constexpr double kFollows = 1.1, kFollowsBy = 3.5;
/// Rings over which normals are averaged.
constexpr int kNormalRings = 2;
constexpr std::size_t kNormalGrain = 4096;
/// Blocks of vertices: each has memory for all vertices.
constexpr std::size_t kBlocks = 32;

/// Normals averaged over rings of neighbors.
std::vector<Vec3> smooth_normals(const engine::Context& context, const TriMesh& mesh,
                                 const Neighbors& neighbors) {
  std::vector<Vec3> normals = vertex_normals(mesh), next(normals.size());
  for (int pass = 0; pass < kNormalRings; ++pass) {
    engine::parallel_for(context, normals.size(), kNormalGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        Vec3 sum = normals[v];
        for (const Index other : neighbors.of(v)) sum += normals[other];
        next[v] = sum.normalized();
      }
    });
    normals.swap(next);
  }
  return normals;
}

/// The range that a height lies in, as the fits so far have it.
struct HeightRange {
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  /// Narrows it by another fit; false where the two do not meet.
  bool meet(double value, double deviation) {
    low = std::max(low, value - kAgree * deviation);
    high = std::min(high, value + kAgree * deviation);
    return low <= high;
  }
};

/// Finds where vertices lie without noise.
class Smoother {
 public:
  Smoother(const TriMesh& noisy, std::span<const Vec3> normals, double noise, double longest)
      : noisy_(noisy), normals_(normals), noise_(noise), longest_(longest) {}

  /// How far a vertex moves along its normal.
  double height(Rings& rings, Index vertex) const {
    const Vec3& origin = noisy_.positions[vertex];
    const double farthest = std::max(kFarthest * longest_, 4.0 * noise_);
    Quadric quadric(origin, normals_[vertex], farthest);
    quadric.add(origin);
    HeightRange range;
    double best = 0.0;
    rings.begin(vertex);
    for (;;) {
      const auto ring = rings.grow();
      if (ring.empty() || !add(ring, origin, farthest, quadric)) return best;
      const auto fit = quadric.value();
      if (!fit) continue;
      const double deviation = noise_ * std::sqrt(fit->variance);
      if (!follows(*fit, quadric.count()) || !range.meet(fit->height, deviation)) return best;
      best = fit->height;
      if (deviation < kCertain * longest_) return best;
    }
  }

 private:
  /// Whether the ring's vertices are near enough on average; they are added.
  bool add(std::span<const Index> ring, const Vec3& origin, double farthest, Quadric& quadric) const {
    double sum = 0.0;
    for (const Index v : ring) {
      sum += (noisy_.positions[v] - origin).norm();
      quadric.add(noisy_.positions[v]);
    }
    return sum < farthest * static_cast<double>(ring.size());
  }

  bool follows(const Quadric::Value& fit, int count) const {
    const double most = kFollows + kFollowsBy * std::sqrt(2.0 / (count - 6));
    return fit.residual < most * noise_ * noise_;
  }

  const TriMesh& noisy_;
  std::span<const Vec3> normals_;
  double noise_, longest_;
};

}  // namespace

std::vector<Vec3> without_noise(const engine::Context& context, const TriMesh& mesh, double noise,
                                std::span<const Index> vertices) {
  const double longest = bounding_box(mesh.positions).size().maxCoeff();
  const Neighbors neighbors(mesh);
  const std::size_t grain = vertices.size() / kBlocks + 1;
  const std::vector<Vec3> normals = smooth_normals(context, mesh, neighbors);
  const Smoother smoother(mesh, normals, noise, longest);
  std::vector<Vec3> smooth(vertices.size());
  engine::parallel_for(context, vertices.size(), grain, [&](std::size_t begin, std::size_t end) {
    Rings rings(neighbors);
    for (std::size_t i = begin; i < end; ++i) {
      const Index v = vertices[i];
      smooth[i] = mesh.positions[v];
      if (normals[v].squaredNorm() > 0.5) smooth[i] += smoother.height(rings, v) * normals[v];
    }
  });
  return smooth;
}

std::vector<Vec3> without_noise(const engine::Context& context, const TriMesh& mesh, double noise) {
  std::vector<Index> all(mesh.positions.size());
  std::iota(all.begin(), all.end(), Index{0});
  return without_noise(context, mesh, noise, all);
}

}  // namespace bodice::geometry
