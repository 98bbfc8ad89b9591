#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

#include <bodice/cloth/weld.hpp>
#include <bodice/geometry/disjoint_sets.hpp>

namespace bodice::inline v0_1::cloth {
namespace {

using geometry::Index;
using geometry::kNoIndex;
using geometry::Triangle;
using geometry::TriMesh;
using geometry::Vec3;

// A triangle counts as flat if twice its area over the square of its longest edge is below this.
constexpr double kFlatRelative = 1e-7;

bool usable_indices(const TriMesh& mesh, const Triangle& t) {
  for (const Index v : t) {
    if (v >= mesh.positions.size() || !mesh.positions[v].allFinite()) return false;
  }
  return true;
}

double median_edge(const TriMesh& mesh) {
  std::vector<double> lengths;
  lengths.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    if (!usable_indices(mesh, t)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = (mesh.positions[t[k]] - mesh.positions[t[(k + 1) % 3]]).norm();
      if (length > 0.0 && std::isfinite(length)) lengths.push_back(length);
    }
  }
  if (lengths.empty()) return 0.0;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

struct Cell {
  std::array<std::int64_t, 3> key;
  Index vertex;
  bool operator<(const Cell& other) const {
    return key != other.key ? key < other.key : vertex < other.vertex;
  }
};

std::vector<Cell> sorted_cells(const TriMesh& mesh, double tolerance, const std::vector<bool>& repeats) {
  geometry::Box box;
  for (const Vec3& p : mesh.positions) {
    if (p.allFinite()) box.extend(p);
  }
  // At most 2^40 cells a side keep integers exact. A garment so large in comparison with its edges has no
  // seams to weld.
  const double cell = std::max(tolerance, box.empty() ? 0.0 : box.size().maxCoeff() * 0x1.0p-40);
  std::vector<Cell> cells;
  for (Index v = 0; v < mesh.positions.size(); ++v) {
    if (!mesh.positions[v].allFinite() || repeats[v]) continue;
    const Vec3 q = cell > 0.0 ? Vec3((mesh.positions[v] - box.low) / cell) : Vec3(Vec3::Zero());
    cells.push_back({{std::int64_t(q[0]), std::int64_t(q[1]), std::int64_t(q[2])}, v});
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

// Unites vertices at the same position, and returns which of them repeat an earlier vertex. Repeats stay out
// of the grid: some files hide parts by collapsing them into one point, which would fill one cell.
std::vector<bool> unite_repeats(const TriMesh& mesh, geometry::DisjointSets& linked) {
  std::vector<Index> order(mesh.positions.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::erase_if(order, [&](Index v) { return !mesh.positions[v].allFinite(); });
  const auto key = [&](Index v) {
    const Vec3& p = mesh.positions[v];
    return std::tuple(p.x(), p.y(), p.z(), v);
  };
  std::ranges::sort(order, {}, key);
  std::vector<bool> repeats(mesh.positions.size(), false);
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (mesh.positions[order[i]] != mesh.positions[order[i - 1]]) continue;
    repeats[order[i]] = true;
    linked.unite(order[i - 1], order[i]);
  }
  return repeats;
}

// The representative of each vertex: the lowest index among the vertices linked by steps of at most
// `tolerance`.
std::vector<Index> representatives(const TriMesh& mesh, double tolerance) {
  geometry::DisjointSets linked(mesh.positions.size());
  const std::vector<Cell> cells = sorted_cells(mesh, tolerance, unite_repeats(mesh, linked));
  for (const Cell& c : cells) {
    for (int n = 0; n < 9; ++n) {  // three cells along z are one run of the sorted list
      const std::array<std::int64_t, 3> low = {c.key[0] + n / 3 - 1, c.key[1] + n % 3 - 1, c.key[2] - 1};
      for (auto it = std::lower_bound(cells.begin(), cells.end(), Cell{low, 0}); it != cells.end(); ++it) {
        if (it->key[0] != low[0] || it->key[1] != low[1] || it->key[2] > c.key[2] + 1) break;
        if (it->vertex >= c.vertex) continue;
        if ((mesh.positions[it->vertex] - mesh.positions[c.vertex]).norm() > tolerance) continue;
        linked.unite(it->vertex, c.vertex);
      }
    }
  }
  std::vector<Index> rep(mesh.positions.size());
  for (Index v = 0; v < rep.size(); ++v) rep[v] = linked.find(v);
  return rep;
}

// Joins the ends of edges that are too short. The end with the lower index represents both, unless another
// vertex represents it already. So no chain of short edges shrinks to a point, and no vertex moves farther
// than `tolerance`.
void join_short_edges(const TriMesh& mesh, double tolerance, std::vector<Index>& rep) {
  std::vector<std::pair<Index, Index>> edges;
  for (const Triangle& t : mesh.triangles) {
    if (!usable_indices(mesh, t)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(rep[t[k]], rep[t[(k + 1) % 3]]);
      if (a != b && (mesh.positions[a] - mesh.positions[b]).norm() < tolerance) edges.emplace_back(a, b);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<Index> joined(rep.size());
  std::iota(joined.begin(), joined.end(), Index{0});
  for (const auto& [a, b] : edges)  // edges ascend in a, so that it is known whether a joined another vertex
    if (joined[a] == a && joined[b] == b) joined[b] = a;
  for (Index& r : rep) r = joined[r];
}

bool has_area(const TriMesh& mesh, const Triangle& t) {
  const Vec3 a = mesh.positions[t[0]], u = mesh.positions[t[1]] - a, v = mesh.positions[t[2]] - a;
  const double longest = std::max({u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()});
  return std::isfinite(longest) && u.cross(v).norm() > kFlatRelative * longest;
}

// The triangles with representatives as corners, without flat and repeated ones.
std::vector<Triangle> kept_triangles(const TriMesh& garment, const std::vector<Index>& rep) {
  std::vector<std::pair<Triangle, std::size_t>> keyed;
  std::vector<Triangle> over_reps;
  for (const Triangle& t : garment.triangles) {
    if (!usable_indices(garment, t)) continue;
    const Triangle r = {rep[t[0]], rep[t[1]], rep[t[2]]};
    if (r[0] == r[1] || r[1] == r[2] || r[2] == r[0] || !has_area(garment, r)) continue;
    Triangle key = r;
    std::sort(key.begin(), key.end());
    keyed.emplace_back(key, over_reps.size());
    over_reps.push_back(r);
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < keyed.size(); ++i) {
    if (i == 0 || keyed[i].first != keyed[i - 1].first) first.push_back(keyed[i].second);
  }
  std::sort(first.begin(), first.end());
  std::vector<Triangle> kept;
  for (const std::size_t f : first) kept.push_back(over_reps[f]);
  return kept;
}

void warn_about_drops(const TriMesh& garment, WeldedGarment& out) {
  std::size_t not_finite = 0, unused = 0;
  for (std::size_t v = 0; v < garment.positions.size(); ++v) {
    if (!garment.positions[v].allFinite())
      ++not_finite;
    else if (out.particle_of_vertex[v] == kNoIndex)
      ++unused;
  }
  const std::size_t flat = garment.triangles.size() - out.mesh.triangles.size();
  auto warn = [&](std::size_t count, const char* code, const char* what, const char* remedy) {
    if (count > 0) out.warnings.push_back({code, "garment", std::to_string(count) + what, remedy});
  };
  warn(not_finite, "garment-vertices-not-finite", " vertices are NaN or infinite and were dropped.",
       "Export the garment again.");
  warn(unused, "garment-vertices-isolated", " vertices belong to no usable triangle and stay where they are.",
       "");
  warn(flat, "garment-triangles-dropped",
       " triangles have no size, repeat another or use a dropped vertex, and were dropped.", "");
}

}  // namespace

engine::Result<WeldedGarment> weld(const TriMesh& garment, double seam_relative) {
  WeldedGarment out;
  const double median_m = median_edge(garment);
  std::vector<Index> rep = representatives(garment, std::max(0.0, seam_relative) * median_m);
  join_short_edges(garment, kShortRelative * median_m, rep);
  out.mesh.triangles = kept_triangles(garment, rep);
  if (out.mesh.triangles.empty()) {
    return engine::Error{engine::ErrorCode::kUnusableGeometry,
                         "The garment has no triangle with an area and finite corners.",
                         "Give a triangle mesh; lines and points cannot be draped."};
  }
  std::vector<Index> particle_of_rep(garment.positions.size(), kNoIndex);
  for (const Triangle& t : out.mesh.triangles) {
    for (const Index v : t) particle_of_rep[v] = 0;
  }
  for (Index v = 0; v < garment.positions.size(); ++v) {
    if (particle_of_rep[v] == kNoIndex) continue;
    particle_of_rep[v] = static_cast<Index>(out.mesh.positions.size());
    out.mesh.positions.push_back(garment.positions[v]);
  }
  for (Triangle& t : out.mesh.triangles) {
    for (Index& v : t) v = particle_of_rep[v];
  }
  out.particle_of_vertex.resize(garment.positions.size());
  for (std::size_t v = 0; v < rep.size(); ++v) out.particle_of_vertex[v] = particle_of_rep[rep[v]];
  out.median_edge_m = median_edge(out.mesh);
  warn_about_drops(garment, out);
  return out;
}

}  // namespace bodice::cloth
