// Based on: Mark Lanthier, Anil Maheshwari, Joerg-Ruediger Sack. Approximating Shortest Paths on Weighted
// Polyhedral Surfaces. 2001. (extra edges that cross the faces)
// Differs: instead of points on the edges, one straight link across each convex pair of unfolded triangles.
#include <cmath>
#include <optional>

#include <bodice/engine/parallel.hpp>
#include <bodice/geodesic/edge_graph.hpp>

namespace bodice::inline v0_1::geodesic {
namespace {

using geometry::Index;
using geometry::kNoIndex;
using geometry::Vec3;

constexpr std::size_t kGrain = 4096;
/// A least length, relative to the mean edge. A zero-length link would let the queue revisit a vertex without
/// progress.
constexpr double kShortestRelative = 1e-6;

Index opposite(const geometry::Triangle& t, const geometry::MeshEdges::Ends& ends) {
  for (const Index v : t)
    if (v != ends[0] && v != ends[1]) return v;
  return kNoIndex;
}

struct Flat {
  double x, y;  ///< along the hinge from its first end, and away from it
};

Flat lay_flat(const Vec3& a, const Vec3& hinge, double hinge_length, const Vec3& p) {
  const double x = (p - a).dot(hinge) / hinge_length;
  return {x, std::sqrt(std::max(0.0, (p - a).squaredNorm() - x * x))};
}

/// The straight link between the two corners opposite an edge, if it stays inside the two triangles.
std::optional<Bridge> across(const geometry::TriMesh& mesh, const geometry::MeshEdges& edges, std::size_t e) {
  const auto [f, g] = edges.triangles[e];
  if (g == kNoIndex) return std::nullopt;
  const Index p = opposite(mesh.triangles[f], edges.ends[e]);
  const Index q = opposite(mesh.triangles[g], edges.ends[e]);
  if (p == kNoIndex || q == kNoIndex || p == q) return std::nullopt;
  const Vec3& a = mesh.positions[edges.ends[e][0]];
  const Vec3 hinge = mesh.positions[edges.ends[e][1]] - a;
  const double length = hinge.norm();
  if (!(length > 0.0)) return std::nullopt;
  const Flat u = lay_flat(a, hinge, length, mesh.positions[p]);
  const Flat w = lay_flat(a, hinge, length, mesh.positions[q]);
  if (!(u.y + w.y > 0.0)) return std::nullopt;
  const double crossing = (u.x * w.y + w.x * u.y) / (u.y + w.y);
  if (crossing <= 0.0 || crossing >= length) return std::nullopt;
  const double along = u.x - w.x, away = u.y + w.y;
  return Bridge{p, q, static_cast<float>(std::sqrt(along * along + away * away))};
}

std::vector<Bridge> two_way_links(const engine::Context& context, const geometry::TriMesh& mesh,
                                  const geometry::MeshEdges& edges, Metric metric) {
  const std::size_t per_edge = metric == Metric::kUnfolded ? 2 : 1;
  std::vector<Bridge> links(per_edge * edges.ends.size());
  engine::parallel_for(context, edges.ends.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const auto [a, b] = edges.ends[e];
      const auto length = static_cast<float>((mesh.positions[b] - mesh.positions[a]).norm());
      links[per_edge * e] = {a, b, length};
      if (per_edge == 2) links[2 * e + 1] = across(mesh, edges, e).value_or(Bridge{});
    }
  });
  return links;
}

/// Builds compressed rows from bridges. A bridge from a vertex to itself stands for "none".
EdgeGraph compress(std::size_t vertices, const std::vector<Bridge>& bridges) {
  EdgeGraph graph;
  graph.offset.assign(vertices + 1, 0);
  double sum = 0.0;
  std::size_t count = 0;
  for (const Bridge& b : bridges) {
    if (b.from == b.to) continue;
    ++graph.offset[b.from + 1];
    ++graph.offset[b.to + 1];
    ++count;
    if (std::isfinite(b.length)) sum += static_cast<double>(b.length);
  }
  for (std::size_t v = 1; v <= vertices; ++v) graph.offset[v] += graph.offset[v - 1];
  graph.links.resize(2 * count);
  graph.mean = count > 0 ? static_cast<float>(sum / static_cast<double>(count)) : 0.0F;
  const float shortest =
      std::max(static_cast<float>(kShortestRelative) * graph.mean, std::numeric_limits<float>::min());
  std::vector<Index> next(graph.offset.begin(), graph.offset.end() - 1);
  for (const Bridge& b : bridges) {
    if (b.from == b.to) continue;
    const float length = std::isfinite(b.length) ? std::max(b.length, shortest) : shortest;
    graph.links[next[b.from]++] = {b.to, length};
    graph.links[next[b.to]++] = {b.from, length};
    graph.longest = std::max(graph.longest, length);
  }
  return graph;
}

}  // namespace

EdgeGraph edge_graph(const engine::Context& context, const geometry::TriMesh& mesh,
                     const geometry::MeshEdges& edges, Metric metric) {
  return compress(mesh.positions.size(), two_way_links(context, mesh, edges, metric));
}

EdgeGraph with_bridges(const EdgeGraph& graph, const std::vector<Bridge>& bridges) {
  std::vector<Bridge> all;
  all.reserve(graph.links.size() / 2 + bridges.size());
  for (std::size_t v = 0; v < graph.vertex_count(); ++v)
    for (Index k = graph.offset[v]; k < graph.offset[v + 1]; ++k)
      if (v < graph.links[k].to)
        all.push_back({static_cast<Index>(v), graph.links[k].to, graph.links[k].length});
  all.insert(all.end(), bridges.begin(), bridges.end());
  return compress(graph.vertex_count(), all);
}

}  // namespace bodice::geodesic
