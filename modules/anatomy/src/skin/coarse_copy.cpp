#include "skin/coarse_copy.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <bodice/geometry/disjoint_sets.hpp>
#include <bodice/geometry/mesh_edges.hpp>

namespace bodice::anatomy {
namespace {

using geometry::Index;
using geometry::kNoIndex;
using geometry::TriMesh;
using geometry::Vec3;

/// Cells as long as this have some hundred thousand patches on them; about 5 mm of a person.
constexpr double kPatches = 80000.0;
/// What a cell holds is no patch of its own where it has fewer vertices than this share of the mean.
constexpr double kSliver = 0.3;
constexpr double kCellsOfAxis = 0x1p20;

/// The vertices that follow each vertex in its triangles, in compressed rows.
struct Followers {
  std::vector<Index> offset, vertex;

  explicit Followers(const TriMesh& mesh)
      : offset(mesh.positions.size() + 1), vertex(3 * mesh.triangles.size()) {
    for (const auto& t : mesh.triangles)
      for (const Index v : t) ++offset[v + 1];
    for (std::size_t v = 1; v < offset.size(); ++v) offset[v] += offset[v - 1];
    std::vector<Index> next(offset.begin(), offset.end() - 1);
    for (const auto& t : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k) vertex[next[t[k]]++] = t[(k + 1) % 3];
  }
};

/// The cell of each vertex.
std::vector<std::uint64_t> cells_of(const TriMesh& mesh, double cell) {
  const Vec3 low = geometry::bounding_box(mesh.positions).low;
  std::vector<std::uint64_t> cells(mesh.positions.size());
  for (std::size_t v = 0; v < cells.size(); ++v) {
    const Vec3 at = (mesh.positions[v] - low) / cell;
    for (int axis = 0; axis < 3; ++axis)
      cells[v] = cells[v] << 20 | static_cast<std::uint64_t>(std::clamp(at[axis], 0.0, kCellsOfAxis - 1.0));
  }
  return cells;
}

/// One vertex of each connected bit of the skin in a cell, the nearest to the bit's middle. Slivers have
/// none.
std::vector<Index> seeds_of(const TriMesh& mesh, double cell) {
  const std::vector<std::uint64_t> cells = cells_of(mesh, cell);
  geometry::DisjointSets sets(cells.size());
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (cells[t[k]] == cells[t[(k + 1) % 3]]) sets.unite(t[k], t[(k + 1) % 3]);
  struct Bit {
    Vec3 sum = Vec3::Zero();
    Index count = 0, seed = kNoIndex;
    double nearest = 0.0;
  };
  std::vector<Index> bit_of(cells.size(), kNoIndex);
  std::vector<Bit> bits;
  const auto bit = [&](std::size_t v) -> Bit& { return bits[bit_of[sets.find(static_cast<Index>(v))]]; };
  for (std::size_t v = 0; v < cells.size(); ++v) {
    Index& own = bit_of[sets.find(static_cast<Index>(v))];
    if (own == kNoIndex) own = static_cast<Index>(bits.size()), bits.emplace_back();
    bits[own].sum += mesh.positions[v];
    ++bits[own].count;
  }
  for (std::size_t v = 0; v < cells.size(); ++v) {
    Bit& own = bit(v);
    const double away = (mesh.positions[v] - own.sum / own.count).squaredNorm();
    if (own.seed != kNoIndex && away >= own.nearest) continue;
    own.seed = static_cast<Index>(v);
    own.nearest = away;
  }
  const double least = kSliver * static_cast<double>(cells.size()) / static_cast<double>(bits.size());
  std::vector<Index> seeds;
  for (const Bit& b : bits)
    if (b.count >= least) seeds.push_back(b.seed);
  return seeds;
}

/// The seed that is fewest edges away from each vertex, by its number; kNoIndex where none is connected.
std::vector<Index> patches_around(const std::vector<Index>& seeds, const Followers& followers) {
  std::vector<Index> patch(followers.offset.size() - 1, kNoIndex), front = seeds;
  for (std::size_t i = 0; i < seeds.size(); ++i) patch[seeds[i]] = static_cast<Index>(i);
  front.reserve(patch.size());
  for (std::size_t i = 0; i < front.size(); ++i)
    for (Index e = followers.offset[front[i]]; e < followers.offset[front[i] + 1]; ++e) {
      const Index next = followers.vertex[e];
      if (patch[next] != kNoIndex) continue;
      patch[next] = patch[front[i]];
      front.push_back(next);
    }
  return patch;
}

/// Triangles of patches that meet in one. Of those between the same three, as many face one side as the other
/// where a patch lies between two alone: they cancel.
std::vector<geometry::Triangle> joined(const TriMesh& mesh, const std::vector<Index>& patch) {
  struct Side {
    geometry::Triangle corners;
    int turn;
  };
  std::vector<Side> sides;
  for (const auto& t : mesh.triangles) {
    geometry::Triangle c{patch[t[0]], patch[t[1]], patch[t[2]]};
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
    std::rotate(c.begin(), std::ranges::min_element(c), c.end());
    const int turn = c[1] < c[2] ? 1 : -1;
    if (turn < 0) std::swap(c[1], c[2]);
    sides.push_back({c, turn});
  }
  std::ranges::sort(sides, {}, &Side::corners);
  std::vector<geometry::Triangle> triangles;
  for (std::size_t i = 0; i < sides.size();) {
    int turns = 0;
    geometry::Triangle c = sides[i].corners;
    for (; i < sides.size() && sides[i].corners == c; ++i) turns += sides[i].turn;
    if (turns == 0) continue;
    if (turns < 0) std::swap(c[1], c[2]);
    triangles.push_back(c);
  }
  return triangles;
}

}  // namespace

std::optional<CoarseCopy> coarse_copy(const engine::Context& context, const TriMesh& skin) {
  const double cell = std::sqrt(geometry::surface_area(skin) / kPatches);
  if (!(cell > 0.0)) return std::nullopt;
  CoarseCopy copy;
  copy.origin = seeds_of(skin, cell);
  context.checkpoint();
  copy.nearest = patches_around(copy.origin, Followers(skin));
  copy.mesh.triangles = joined(skin, copy.nearest);
  for (const Index v : copy.origin) copy.mesh.positions.push_back(skin.positions[v]);
  const geometry::MeshEdges edges = geometry::mesh_edges(copy.mesh);
  if (edges.non_manifold > 0) return std::nullopt;
  return copy;
}

}  // namespace bodice::anatomy
