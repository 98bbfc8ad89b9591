#include <bodice/geometry/thin.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "repair/merging.hpp"
#include "repair/smooth_groups.hpp"

namespace bodice::inline v0_1::geometry {
namespace {

/// Slabs across the longest side, with about as many vertices each, and how many these have at least. Between
/// slabs the surface stays as it is.
constexpr std::size_t kMostSlabs = 32, kVerticesOfSlab = 4096;
/// Bins of the longest side, of which slabs are made.
constexpr std::size_t kSlabBins = 4096;
constexpr std::size_t kGrainOfAverages = 4096;
/// The second turn has its slabs across the borders of the first one's.
constexpr std::array kShifts = {0.0, 0.5};
/// Noisy surfaces are judged after so many averages over neighbors, which leave this share of the noise.
constexpr int kAverages = 3;
constexpr double kNoiseLeft = 0.3;

std::size_t slab_count(std::size_t vertices) {
  return std::min(kMostSlabs, 1 + vertices / kVerticesOfSlab);
}

/// The slab of each vertex.
std::vector<std::uint8_t> slabs(const std::vector<Vec3>& positions, double shift) {
  const Box box = bounding_box(positions);
  Eigen::Index axis = 0;
  const double length = box.size().maxCoeff(&axis);
  const double bins_per_m = length > 0.0 ? static_cast<double>(kSlabBins) / length : 0.0;
  const auto bin_of = [&](const Vec3& p) {
    return std::min<std::size_t>(static_cast<std::size_t>((p[axis] - box.low[axis]) * bins_per_m),
                                 kSlabBins - 1);
  };
  std::vector<std::size_t> below(kSlabBins + 1, 0);
  for (const Vec3& p : positions) ++below[bin_of(p) + 1];
  for (std::size_t bin = 0; bin < kSlabBins; ++bin) below[bin + 1] += below[bin];
  const double slabs_per_vertex =
      static_cast<double>(slab_count(positions.size())) / static_cast<double>(positions.size());
  std::vector<std::uint8_t> slab(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v)
    slab[v] = static_cast<std::uint8_t>(static_cast<double>(below[bin_of(positions[v])]) * slabs_per_vertex +
                                        shift);
  return slab;
}

/// The vertices of each slab, ascending.
std::vector<std::vector<Index>> vertices_of(const std::vector<std::uint8_t>& slab, const Merging& merging) {
  std::vector<std::vector<Index>> vertices(slab_count(slab.size()) + 1);
  for (Index v = 0; v < slab.size(); ++v)
    if (!merging.is_merged(v)) vertices[slab[v]].push_back(v);
  return vertices;
}

/// Each position the mean of its neighbors and itself, again and again.
std::vector<Vec3> averaged(const engine::Context& context, const RoughSurface& surface) {
  const Neighbors& neighbors = surface.neighbors;
  std::vector<Vec3> positions = surface.mesh.positions, next(positions.size());
  for (int pass = 0; pass < kAverages; ++pass) {
    engine::parallel_for(context, positions.size(), kGrainOfAverages,
                         [&](std::size_t begin, std::size_t end) {
                           for (std::size_t v = begin; v < end; ++v) {
                             next[v] = positions[v];
                             for (const Index other : neighbors.of(v)) next[v] += positions[other];
                             next[v] /= static_cast<double>(neighbors.of(v).size() + 1);
                           }
                         });
    positions.swap(next);
  }
  return positions;
}

}  // namespace

ThinnedSurface thin(const engine::Context& context, const TriMesh& mesh, const ThinOptions& options) {
  Merging merging(mesh, options);
  if (mesh.empty()) return merging.finish();
  for (const double shift : kShifts) {
    std::vector<std::uint8_t> slab = slabs(mesh.positions, shift);
    const std::vector<std::vector<Index>> vertices = vertices_of(slab, merging);
    merging.set_blocks(std::move(slab));
    engine::parallel_for(context, vertices.size(), 1, [&](std::size_t begin, std::size_t) {
      for (const Index v : vertices[begin]) merging.merge(v);
    });
  }
  return merging.finish();
}

ThinnedSurface thin_noisy(const engine::Context& context, const RoughSurface& surface, double noise,
                          ThinOptions options) {
  options.tolerance_m = std::max(options.tolerance_m, kNoiseLeft * noise);
  ThinnedSurface thinned = thin(context, {averaged(context, surface), surface.mesh.triangles}, options);
  thinned.mesh.positions = smooth_groups(context, surface.mesh, thinned, noise);
  return thinned;
}

}  // namespace bodice::geometry
