#include <bodice/geometry/noise.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <bodice/engine/parallel.hpp>

#include "repair/quadric.hpp"
#include "repair/rings.hpp"

namespace bodice::inline v0_1::geometry {
namespace {

/// Vertices at which a surface is judged at first, and where it may be noisy.
constexpr std::size_t kFirst = 1000, kThorough = 6000;
/// Noise below this fraction of the longest side, .7 mm of a person, is none: relief has such errors.
constexpr double kLeastNoise = 0.0004;
/// Correlation of the deviations of neighbors: noise has -.2 to 0, real bodies .1 to .2, coarse meshes .3 to
/// .6.
constexpr double kMostCorrelation = 0.05;
/// A quadric that is less certain than its points is no measure of the vertex.
constexpr double kMostVariance = 4.0;
/// Rings around a vertex that its quadric goes through.
constexpr int kRings = 2;
/// The standard deviation of a normal distribution over the median of its absolute values.
constexpr double kNormal = 1.4826;
/// A deviation counts up to so many standard deviations.
constexpr double kOutlier = 5.0;

constexpr std::size_t kGrain = 256;

double longest_side(const TriMesh& mesh) {
  return bounding_box(mesh.positions).size().maxCoeff();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Measures how far vertices lie off their neighbors.
class Deviations {
 public:
  explicit Deviations(const RoughSurface& surface)
      : mesh_(surface.mesh), neighbors_(surface.neighbors), normals_(surface.normals) {}

  /// The deviation of a vertex from the quadric through its rings, over the standard deviation that noise of
  /// 1 would give it.
  std::optional<double> at(Rings& rings, Index vertex) const {
    rings.begin(vertex);
    for (int k = 0; k < kRings; ++k) rings.grow();
    const auto around = rings.all().subspan(1);
    Vec3 normal = Vec3::Zero();
    double farthest = 0.0;
    for (const Index v : around) {
      normal += normals_[v];
      farthest = std::max(farthest, (mesh_.positions[v] - mesh_.positions[vertex]).squaredNorm());
    }
    if (!(normal.squaredNorm() > 0.0) || !(farthest > 0.0)) return std::nullopt;
    Quadric quadric(mesh_.positions[vertex], normal.normalized(), std::sqrt(farthest));
    quadric.add(around, mesh_.positions);
    const auto value = quadric.value();
    if (!value || value->variance > kMostVariance) return std::nullopt;
    return -value->height / std::sqrt(1.0 + value->variance);
  }

  /// Pairs of deviations: of about `count` vertices and of a neighbor of each; 0 without one.
  std::vector<std::array<double, 2>> pairs(const engine::Context& context, std::size_t count) const {
    const std::size_t step = std::max<std::size_t>(1, mesh_.positions.size() / count);
    const std::size_t all = mesh_.positions.size() / step;
    std::vector<std::optional<std::array<double, 2>>> found(all);
    engine::parallel_for(context, all, kGrain, [&](std::size_t begin, std::size_t end) {
      Rings rings(neighbors_);
      for (std::size_t i = begin; i < end; ++i) {
        const auto vertex = static_cast<Index>(i * step);
        if (neighbors_.of(vertex).empty()) continue;
        const auto own = at(rings, vertex);
        const auto other = at(rings, neighbors_.of(vertex).front());
        if (own && other) found[i] = {*own, *other};
      }
    });
    std::vector<std::array<double, 2>> pairs;
    for (const auto& pair : found)
      if (pair) pairs.push_back(*pair);
    return pairs;
  }

 private:
  const TriMesh& mesh_;
  const Neighbors& neighbors_;
  std::span<const Vec3> normals_;
};

double deviation(const std::vector<std::array<double, 2>>& pairs) {
  std::vector<double> sizes;
  for (const auto& pair : pairs) sizes.push_back(std::abs(pair[0]));
  return sizes.empty() ? 0.0 : kNormal * median(std::move(sizes));
}

double correlation(const std::vector<std::array<double, 2>>& pairs, double sigma) {
  double products = 0.0, squares = 0.0;
  for (auto [a, b] : pairs) {
    a = std::clamp(a, -kOutlier * sigma, kOutlier * sigma);
    b = std::clamp(b, -kOutlier * sigma, kOutlier * sigma);
    products += a * b;
    squares += 0.5 * (a * a + b * b);
  }
  return squares > 0.0 ? products / squares : 1.0;
}

}  // namespace

double noise_of(const engine::Context& context, const RoughSurface& surface) {
  if (surface.mesh.empty()) return 0.0;
  const double least = kLeastNoise * longest_side(surface.mesh);
  const Deviations deviations(surface);
  if (deviation(deviations.pairs(context, kFirst)) < least) return 0.0;
  const auto pairs = deviations.pairs(context, kThorough);
  const double sigma = deviation(pairs);
  return sigma < least || correlation(pairs, sigma) > kMostCorrelation ? 0.0 : sigma;
}

}  // namespace bodice::geometry
