// Construction of the coarse levels: the nodes, the particles that each represents, and the ties between
// nodes.
#include "constraints/coarse.hpp"

#include <algorithm>
#include <numeric>

#include "garment/cloth_distance.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

// The spacing of nodes in median edges, coarsest level first, and the most sweeps over the ties.
struct Spacing {
  double edges;
  int sweeps;
};
constexpr Spacing kSpacings[kMostLevels] = {{16.0, 8}, {4.0, 3}};
// Nodes within this many spacings are tied. With ties to the nearest nodes only, a level is a net of few
// directions, which becomes longer as it becomes narrower.
constexpr double kNeighbors = 3.0;
constexpr double kReach = 1.7;        // the parents of a particle lie within this many spacings
constexpr std::size_t kFewNodes = 3;  // a level with so few nodes is left out

void pick_nodes(const geometry::TriMesh& mesh, ClothDistance& distance, double spacing, CoarseLevel& level) {
  std::vector<bool> covered(mesh.positions.size(), false);
  for (Index i = 0; i < covered.size(); ++i) {
    if (covered[i]) continue;
    level.node.push_back(i);
    for (const auto& [d, p] : distance.within(i, spacing)) covered[p] = true;
  }
}

void offer_parent(CoarseLevel& level, Index particle, Index node, float share) {
  Parents& parents = level.parents[particle];
  for (std::size_t k = 0; k < kParents; ++k) {
    if (share <= parents.share[k]) continue;
    std::swap(share, parents.share[k]);
    std::swap(node, parents.node[k]);
  }
}

struct Tie {
  Index a, b;
  float limit_m;
};

std::vector<Tie> tie_nodes(ClothDistance& distance, double spacing, double slack, CoarseLevel& level,
                           const std::vector<Index>& node_of) {
  std::vector<Tie> ties;
  for (Index n = 0; n < level.node.size(); ++n) {
    for (const auto& [d, p] : distance.within(level.node[n], std::max(kNeighbors, kReach) * spacing)) {
      const double t = 1.0 - d / (kReach * spacing);
      if (t > 0.0) offer_parent(level, p, n, static_cast<float>(t * t));
      const Index other = node_of[p];
      if (other == geometry::kNoIndex || other <= n || d > kNeighbors * spacing) continue;
      ties.push_back({n, other, static_cast<float>(d * (1.0 + slack))});
    }
  }
  return ties;
}

Ties make_ties(const std::vector<Tie>& wanted, std::size_t nodes) {
  std::vector<Index> ends;
  for (const Tie& tie : wanted) ends.push_back(tie.a), ends.push_back(tie.b);
  Ties out;
  out.schedule = make_schedule(ends, 2, nodes, kTiePack);
  for (std::size_t slot = 0; slot < out.schedule.slot.size(); ++slot) {
    const std::uint32_t t = out.schedule.slot[slot];
    const Index idle = out.schedule.idle[slot / kTiePack];
    const Tie tie = t == kIdle ? Tie{idle, idle, 1.0f} : wanted[t];
    out.a.push_back(tie.a), out.b.push_back(tie.b), out.limit_m.push_back(tie.limit_m);
  }
  return out;
}

// Lists the particles of each node, with their shares.
void list_children(CoarseLevel& level) {
  level.child_begin.assign(level.node.size() + 1, 0);
  for (const Parents& parents : level.parents)
    for (const Index n : parents.node) ++level.child_begin[n + 1];
  std::partial_sum(level.child_begin.begin(), level.child_begin.end(), level.child_begin.begin());
  level.child.resize(level.child_begin.back());
  std::vector<Index> next(level.child_begin.begin(), level.child_begin.end() - 1);
  for (Index i = 0; i < level.parents.size(); ++i)
    for (std::size_t k = 0; k < kParents; ++k)
      level.child[next[level.parents[i].node[k]]++] = {i, level.parents[i].share[k]};
}

CoarseLevel make_level(const geometry::TriMesh& mesh, ClothDistance& distance, double spacing, double slack) {
  CoarseLevel level;
  const std::size_t count = mesh.positions.size();
  pick_nodes(mesh, distance, spacing, level);
  level.parents.assign(count, {});
  std::vector<Index> node_of(count, geometry::kNoIndex);
  for (Index n = 0; n < level.node.size(); ++n) node_of[level.node[n]] = n;
  level.ties = make_ties(tie_nodes(distance, spacing, slack, level, node_of), level.node.size());
  for (Parents& parents : level.parents) {
    const float sum = std::accumulate(parents.share.begin(), parents.share.end(), 0.0f);
    for (float& share : parents.share) share /= sum;
  }
  list_children(level);
  const std::size_t points = level.node.size() + idle_particles(level.node.size());
  level.at.resize(points), level.before.resize(points);
  level.move.resize(level.node.size()), level.inverse_mass.resize(level.node.size());
  return level;
}

}  // namespace

std::vector<CoarseLevel> make_coarse(const geometry::TriMesh& mesh, const Topology& topology,
                                     double median_edge_m, double slack) {
  std::vector<CoarseLevel> levels;
  ClothDistance distance(mesh, topology);
  for (const Spacing& spacing : kSpacings) {
    CoarseLevel level = make_level(mesh, distance, spacing.edges * median_edge_m, slack);
    level.sweeps = spacing.sweeps;
    if (level.node.size() > kFewNodes && !level.ties.a.empty()) levels.push_back(std::move(level));
  }
  return levels;
}

}  // namespace bodice::cloth
