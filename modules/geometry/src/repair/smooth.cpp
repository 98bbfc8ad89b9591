// Based on: Vladimir Katkovnik. A New Method for Varying Adaptive Bandwidth Selection. 1999. (ranges that
// meet) Based on: Alessandro Foi, Vladimir Katkovnik, Karen Egiazarian. Pointwise Shape-Adaptive DCT for
// High-Quality Denoising and Deblocking of Grayscale and Color Images. 2007. (overlapping estimates, weighed
// by variance and size)
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include <bodice/geometry/noise.hpp>

#include "repair/agreement.hpp"
#include "repair/quadric.hpp"
#include "repair/rings.hpp"
#include "repair/smooth_normals.hpp"

namespace bodice::inline v0_1::geometry {
namespace {

/// Quadrics with normals farther off a vertex' normal than this cosine do not count for it.
constexpr double kAlong = 0.7;

/// The widest quadric around a vertex that its points follow.
struct Widest {
  Quadric quadric;
  double height;    ///< how far the vertex moves along its normal
  double variance;  ///< variance of the height where points have a variance of 1
  int rings;
};

/// Finds what vertices lie on without noise.
class Smoother {
 public:
  Smoother(const TriMesh& noisy, std::span<const Vec3> normals, double noise)
      : noisy_(noisy), normals_(normals), agreement_(noisy.positions, noise) {}

  std::optional<Widest> widest(Rings& rings, Index vertex) const {
    std::optional<Widest> best;
    if (!(normals_[vertex].squaredNorm() > 0.5)) return best;
    const Vec3& origin = noisy_.positions[vertex];
    const double farthest = agreement_.farthest();
    Quadric quadric(origin, normals_[vertex], farthest);
    quadric.add({&vertex, 1}, noisy_.positions);
    HeightRange range;
    rings.begin(vertex);
    for (int count = 1;; ++count) {
      const auto ring = rings.grow();
      if (ring.empty() || !add(ring, origin, farthest, quadric)) return best;
      const auto fit = quadric.value();
      if (!fit) continue;
      if (!agreement_.follows(*fit, quadric.count()) || !range.meet(fit->height, agreement_.deviation(*fit)))
        return best;
      best = {quadric, fit->height, fit->variance, count};
      if (agreement_.is_certain(*fit)) return best;
    }
  }

 private:
  /// Whether the ring's vertices are near enough on average; they are added.
  bool add(std::span<const Index> ring, const Vec3& origin, double farthest, Quadric& quadric) const {
    double sum = 0.0;
    for (const Index v : ring) sum += (noisy_.positions[v] - origin).norm();
    quadric.add(ring, noisy_.positions);
    return sum < farthest * static_cast<double>(ring.size());
  }

  const TriMesh& noisy_;
  std::span<const Vec3> normals_;
  Agreement agreement_;
};

/// What was found around a vertex; without a quadric, that it lies at height 0 as surely as it was measured.
struct Patch {
  QuadricPatch surface;
  double height = 0.0, deviation = 1.0;  ///< the deviation where points have one of 1
  int rings = 0;                         ///< 0: no quadric
};

/// Finds where vertices lie by all quadrics that go through them.
class Consensus {
 public:
  Consensus(const TriMesh& noisy, std::span<const Vec3> normals, std::span<const Patch> patches, double noise)
      : noisy_(noisy), normals_(normals), patches_(patches), noise_(noise) {}

  /// How far a vertex moves along its normal: the mean of what the quadrics give, weighed by their variances
  /// and the number of their points.
  double height(Rings& rings, Index vertex) const {
    double sum = 0.0, weights = 0.0;
    rings.begin(vertex);
    std::span<const Index> ring(&vertex, 1);
    for (int distance = 0; !ring.empty(); ring = rings.grow(), ++distance) {
      bool reached = distance == 0;
      for (const Index v : ring) {
        if (patches_[v].rings == 0 || patches_[v].rings < distance) continue;
        reached = true;
        const auto [height, weight] = opinion(patches_[v], vertex);
        sum += weight * height;
        weights += weight;
      }
      if (!reached) break;
    }
    return weights > 0.0 ? sum / weights : 0.0;
  }

 private:
  struct Opinion {
    double height, weight;
  };

  /// What a patch gives for a vertex; no weight where it does not agree with the vertex' own one.
  Opinion opinion(const Patch& patch, Index vertex) const {
    const Patch& own = patches_[vertex];
    const double along = patch.surface.normal().dot(normals_[vertex]);
    if (along < kAlong) return {0.0, 0.0};
    const auto [offset, variance] = patch.surface.offset(noisy_.positions[vertex]);
    const double most = kAgree * noise_ * (std::sqrt(variance) + own.deviation);
    if (std::abs(offset - own.height) > most) return {0.0, 0.0};
    return {along * offset, 1.0 / (variance * patch.rings * patch.rings)};
  }

  const TriMesh& noisy_;
  std::span<const Vec3> normals_;
  std::span<const Patch> patches_;
  double noise_;
};

}  // namespace

std::vector<Vec3> without_noise(const engine::Context& context, const RoughSurface& surface, double noise) {
  const TriMesh& mesh = surface.mesh;
  const Neighbors& neighbors = surface.neighbors;
  const std::vector<Vec3> normals = smooth_normals(context, neighbors, surface.normals);
  const Smoother smoother(mesh, normals, noise);
  std::vector<Patch> patches(mesh.positions.size());
  for_each_with_rings(context, neighbors, [&](Index v, Rings& rings) {
    if (const auto found = smoother.widest(rings, v))
      patches[v] = {found->quadric.patch(), found->height, std::sqrt(found->variance), found->rings};
  });
  const Consensus consensus(mesh, normals, patches, noise);
  std::vector<Vec3> smooth = mesh.positions;
  for_each_with_rings(context, neighbors, [&](Index v, Rings& rings) {
    if (normals[v].squaredNorm() > 0.5) smooth[v] += consensus.height(rings, v) * normals[v];
  });
  return smooth;
}

}  // namespace bodice::geometry
