#include "mesh/patches.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "mesh/cage_builder.hpp"

namespace bodice::inline v0_1::synth {
namespace {

using geometry::Index;

/// Corner coordinates of a quad, in order.
constexpr std::array<std::array<double, 2>, 4> kCorners = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

Index add_vertex(PatchMesh& mesh, const PatchPoint& at, Region region) {
  mesh.at.push_back(at);
  mesh.region.push_back(region);
  return static_cast<Index>(mesh.at.size() - 1);
}

}  // namespace

Patches::Patches(const Cage& cage) : cage_(cage) {
  find_edges();
  find_classes();
}

void Patches::find_edges() {
  std::map<std::pair<int, int>, int> known;
  edge_of_quad_.resize(cage_.quads.size());
  for (std::size_t q = 0; q < cage_.quads.size(); ++q)
    for (int k = 0; k < 4; ++k) {
      const auto [a, b] = std::minmax(cage_.quads[q][k], cage_.quads[q][(k + 1) % 4]);
      const auto [entry, added] = known.try_emplace({a, b}, static_cast<int>(edges_.size()));
      if (added)
        edges_.push_back({a, b, -1, cage_.quad_region[q]});
      else
        edges_[entry->second].region = shared_region(edges_[entry->second].region, cage_.quad_region[q]);
      edge_of_quad_[q][k] = entry->second;
    }
  for (Edge& e : edges_)  // the floor of the trunk, with its front and back rim
    if (cage_.region[e.a] == Region::kCrotch || cage_.region[e.b] == Region::kCrotch)
      if (std::abs(cage_.positions[e.a].x()) < 1e-12 && std::abs(cage_.positions[e.b].x()) < 1e-12)
        e.region = Region::kCrotch;
}

void Patches::find_classes() {
  std::vector<int> root(edges_.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int e) {
    while (root[e] != e) e = root[e] = root[root[e]];
    return e;
  };
  for (const auto& of_quad : edge_of_quad_)
    for (int k = 0; k < 2; ++k) root[find(of_quad[k])] = find(of_quad[k + 2]);
  std::vector<int> number(edges_.size(), -1);
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    int& n = number[find(static_cast<int>(e))];
    if (n < 0) n = class_count_++;
    edges_[e].edge_class = n;
  }
}

std::vector<double> Patches::class_lengths(const std::vector<Vec3>& cage_positions) const {
  std::vector<double> sum(class_count_, 0.0), number(class_count_, 0.0);
  for (const Edge& e : edges_) {
    sum[e.edge_class] += (cage_positions[e.a] - cage_positions[e.b]).norm();
    number[e.edge_class] += 1.0;
  }
  // Sums are snapped to a grid, so that left and right do not differ in their last bits.
  for (int c = 0; c < class_count_; ++c) sum[c] = 1e-9 * std::round(1e9 * sum[c] / number[c]);
  return sum;
}

std::int64_t Patches::vertex_count(const std::vector<int>& counts) const {
  std::int64_t total = static_cast<std::int64_t>(cage_.positions.size());
  for (const Edge& e : edges_) total += counts[e.edge_class] - 1;
  for (const auto& of_quad : edge_of_quad_)
    total +=
        std::int64_t{counts[edges_[of_quad[0]].edge_class] - 1} * (counts[edges_[of_quad[1]].edge_class] - 1);
  return total;
}

std::vector<Index> Patches::edge_vertices(PatchMesh& mesh, int quad, int k, const std::vector<int>& counts,
                                          std::vector<std::vector<Index>>& of_edge) const {
  const int e = edge_of_quad_[quad][k];
  const Edge& edge = edges_[e];
  const int n = counts[edge.edge_class];
  const bool forward = cage_.quads[quad][k] == edge.a;
  if (of_edge[e].empty()) {  // ordered from a to b
    of_edge[e].push_back(static_cast<Index>(edge.a));
    for (int i = 1; i < n; ++i) {
      const double t = forward ? static_cast<double>(i) / n : static_cast<double>(n - i) / n;
      const auto &from = kCorners[k], &to = kCorners[(k + 1) % 4];
      const PatchPoint at{quad, from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])};
      of_edge[e].push_back(add_vertex(mesh, at, edge.region));
    }
    of_edge[e].push_back(static_cast<Index>(edge.b));
  }
  std::vector<Index> line = of_edge[e];
  if (!forward) std::reverse(line.begin(), line.end());
  return line;
}

PatchMesh Patches::tessellate(const std::vector<int>& counts) const {
  PatchMesh mesh;
  mesh.at.resize(cage_.positions.size());
  mesh.region = cage_.region;
  std::vector<std::vector<Index>> of_edge(edges_.size());
  for (int q = 0; q < static_cast<int>(cage_.quads.size()); ++q) {
    for (int k = 0; k < 4; ++k) mesh.at[cage_.quads[q][k]] = {q, kCorners[k][0], kCorners[k][1]};
    const auto bottom = edge_vertices(mesh, q, 0, counts, of_edge),
               right = edge_vertices(mesh, q, 1, counts, of_edge);
    auto top = edge_vertices(mesh, q, 2, counts, of_edge), left = edge_vertices(mesh, q, 3, counts, of_edge);
    std::reverse(top.begin(), top.end());
    std::reverse(left.begin(), left.end());
    const int nu = static_cast<int>(bottom.size()) - 1, nv = static_cast<int>(right.size()) - 1;
    std::vector<Index> grid((nu + 1) * (nv + 1));
    for (int r = 0; r <= nv; ++r)
      for (int c = 0; c <= nu; ++c) {
        Index& v = grid[r * (nu + 1) + c];
        if (r == 0)
          v = bottom[c];
        else if (r == nv)
          v = top[c];
        else if (c == 0)
          v = left[r];
        else if (c == nu)
          v = right[r];
        else
          v = add_vertex(mesh, {q, static_cast<double>(c) / nu, static_cast<double>(r) / nv},
                         cage_.quad_region[q]);
      }
    for (int r = 0; r < nv; ++r)
      for (int c = 0; c < nu; ++c) {
        const int i = r * (nu + 1) + c;
        mesh.quads.push_back({grid[i], grid[i + 1], grid[i + nu + 2], grid[i + nu + 1]});
        mesh.cage_quad.push_back(q);
      }
    mesh.counts.push_back({nu, nv});
    mesh.grid.push_back(std::move(grid));
  }
  return mesh;
}

std::vector<int> counts_for(const std::vector<double>& class_lengths, double edge_length) {
  std::vector<int> counts;
  for (const double length : class_lengths)
    counts.push_back(std::max(1, static_cast<int>(std::lround(length / edge_length))));
  return counts;
}

std::vector<int> counts_for_vertices(const Patches& patches, const std::vector<double>& class_lengths,
                                     std::int64_t vertices) {
  // The count falls with the edge length in steps. Bisection finds the step, and the closer of its sides is
  // taken.
  double fine = 1e-4, coarse = 1.0;  // statures
  for (int i = 0; i < 60; ++i) {
    const double middle = std::sqrt(fine * coarse);
    (patches.vertex_count(counts_for(class_lengths, middle)) > vertices ? fine : coarse) = middle;
  }
  const auto above = counts_for(class_lengths, fine), below = counts_for(class_lengths, coarse);
  const std::int64_t over = patches.vertex_count(above) - vertices,
                     under = vertices - patches.vertex_count(below);
  return over < under ? above : below;
}

}  // namespace bodice::synth
