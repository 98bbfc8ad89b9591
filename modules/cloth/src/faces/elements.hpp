// The edges and triangles of a garment, as elements that body contact samples between their particles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

#include "base/particles.hpp"
#include "garment/topology.hpp"

namespace bodice::inline v0_1::cloth {

/// An edge or a triangle of the cloth.
struct Element {
  Index particle[3] = {};  ///< an edge repeats its second particle

  bool is_edge() const { return particle[1] == particle[2]; }
};

/// The number of elements in a run: neighbors on the cloth, with samples that are handled together.
inline constexpr std::size_t kRun = 64;
/// Particles in a cluster: consecutive ones with one bound on their travel.
inline constexpr std::size_t kTravelCluster = 32;

/// All elements of a garment: first those inside blocks of particles (base/schedule.hpp), block by block,
/// then those across blocks; in a group by their first particle, so that neighbors are near each other.
struct Elements {
  std::vector<Element> all;
  std::vector<std::uint32_t> run_begin;      ///< #runs + 1: first element of each run
  std::vector<std::uint32_t> group_run;      ///< #blocks + 2: first run of each block, then of those across
  std::vector<std::uint32_t> cluster_begin;  ///< #runs + 1, offsets into cluster
  std::vector<std::uint32_t> cluster;        ///< the clusters that have particles of a run

  std::size_t groups() const { return group_run.size() - 1; }
  std::size_t runs() const { return run_begin.size() - 1; }
  std::span<const std::uint32_t> clusters_of(std::size_t run) const {
    return {cluster.data() + cluster_begin[run], cluster.data() + cluster_begin[run + 1]};
  }
};

/// The elements of a garment. O(n log n).
Elements make_elements(const geometry::TriMesh& mesh, const Topology& topology);

/// The most parts that an edge of an element is cut into.
inline constexpr int kFinest = 64;

/// The number of samples of an element with edges cut into `parts`: the points of the lattice that lie inside
/// it. Those on a triangle's edges belong to the edges' elements, and the corners are particles.
inline std::size_t lattice_points(bool edge, int parts) {
  const auto n = static_cast<std::size_t>(parts);
  return edge ? n - 1 : n < 3 ? 0 : (n - 1) * (n - 2) / 2;
}

/// Calls visit(b0, b1) with the barycentric weights of the first two particles for each sample, row by row.
template <class Visit>
void for_each_lattice_point(bool edge, int parts, Visit&& visit) {
  const float step = 1.0f / static_cast<float>(parts);
  if (edge) {
    for (int k = 1; k < parts; ++k) {
      const float b1 = static_cast<float>(k) * step;
      visit(1.0f - b1, b1);
    }
    return;
  }
  for (int i = 1; i < parts - 1; ++i)
    for (int j = 1; i + j < parts; ++j) visit(static_cast<float>(i) * step, static_cast<float>(j) * step);
}

}  // namespace bodice::cloth
