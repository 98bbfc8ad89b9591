// Based on: Matthias Mueller. Hierarchical Position Based Dynamics. 2008.
// Differs: nodes carry the mass of all that they stand for, so that momentum is kept; their constraints only
// pull (limits along the cloth), so that folds stay free; the corrections, not the positions, are
// interpolated.
#include "coarse.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <bodice/engine/parallel.hpp>

#include "cloth_distance.hpp"
#include "tiny.hpp"

namespace bodice::cloth {
namespace {

// Node spacings in median edges, coarsest first, and sweeps over each level's limits.
struct Spacing {
  double edges;
  int sweeps;
};
constexpr Spacing kSpacings[] = {{16.0, 8}, {4.0, 3}};
constexpr double kNeighbours = 1.7;  // nodes this many spacings apart are tied
constexpr double kReach = 1.7;       // a particle's parents lie within this many spacings
constexpr std::size_t kFewNodes = 3;

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

void tie_nodes(ClothDistance& distance, double spacing, double slack, CoarseLevel& level,
               const std::vector<Index>& node_of) {
  for (Index n = 0; n < level.node.size(); ++n) {
    for (const auto& [d, p] : distance.within(level.node[n], std::max(kNeighbours, kReach) * spacing)) {
      const double t = 1.0 - d / (kReach * spacing);
      if (t > 0.0) offer_parent(level, p, n, static_cast<float>(t * t));
      const Index other = node_of[p];
      if (other == geometry::kNoIndex || other <= n || d > kNeighbours * spacing) continue;
      level.a.push_back(n), level.b.push_back(other);
      level.limit_m.push_back(static_cast<float>(d * (1.0 + slack)));
    }
  }
}

CoarseLevel make_level(const geometry::TriMesh& mesh, ClothDistance& distance, double spacing, double slack) {
  CoarseLevel level;
  const std::size_t count = mesh.positions.size();
  pick_nodes(mesh, distance, spacing, level);
  level.parents.assign(count, {});
  std::vector<Index> node_of(count, geometry::kNoIndex);
  for (Index n = 0; n < level.node.size(); ++n) node_of[level.node[n]] = n;
  tie_nodes(distance, spacing, slack, level, node_of);
  for (Parents& parents : level.parents) {
    const float sum = std::accumulate(parents.share.begin(), parents.share.end(), 0.0f);
    for (float& share : parents.share) share /= sum;
  }
  level.at.resize(level.node.size()), level.move.resize(level.node.size());
  return level;
}

// One tie; true if it was too long.
bool pull(CoarseLevel& level, std::size_t c) {
  Point &a = level.at[level.a[c]], &b = level.at[level.b[c]];
  const Float4 at_a = load(a), at_b = load(b), d = xyz(at_a - at_b), dd = d * d;
  const float length2 = dd[0] + dd[1] + dd[2], limit = level.limit_m[c];
  if (length2 <= limit * limit) return false;
  const float length = std::sqrt(length2);
  const float scale = (length - limit) / (length * (a.weight + b.weight + kTinyWeight));
  store(b, at_b + scale * b.weight * d);
  store(a, at_a - scale * a.weight * d);
  return true;
}

bool pull(CoarseLevel& level) {
  bool any = false;
  for (std::size_t c = 0; c < level.a.size(); ++c) any = pull(level, c) || any;
  return any;
}

// The nodes' displacements, shared out to the particles they carry.
void carry(const engine::Context& context, const CoarseLevel& level, Particles& p) {
  engine::parallel_for(context, p.count(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (p.point[i].weight == 0.0f) continue;
      const Parents& parents = level.parents[i];
      Float4 sum = splat(0.0f);
      for (std::size_t k = 0; k < kParents; ++k) sum += parents.share[k] * load(level.move[parents.node[k]]);
      store(p.point[i], load(p.point[i]) + sum);
    }
  });
}

void load_nodes(const Particles& p, CoarseLevel& level) {
  for (std::size_t n = 0; n < level.node.size(); ++n) {
    const Point& from = p.point[level.node[n]];
    level.at[n].x = from.x, level.at[n].y = from.y, level.at[n].z = from.z;
  }
}

void to_displacements(const Particles& p, CoarseLevel& level) {
  for (std::size_t n = 0; n < level.node.size(); ++n)
    store(level.move[n], xyz(load(level.at[n]) - load(p.point[level.node[n]])));
}

}  // namespace

std::vector<CoarseLevel> make_coarse(const geometry::TriMesh& mesh, const Topology& topology,
                                     double median_edge_m, double slack) {
  std::vector<CoarseLevel> levels;
  ClothDistance distance(mesh, topology);
  for (const Spacing& spacing : kSpacings) {
    CoarseLevel level = make_level(mesh, distance, spacing.edges * median_edge_m, slack);
    level.sweeps = spacing.sweeps;
    if (level.node.size() > kFewNodes && !level.a.empty()) levels.push_back(std::move(level));
  }
  return levels;
}

void update_weights(const Particles& p, std::vector<CoarseLevel>& levels) {
  for (CoarseLevel& level : levels) {
    for (Point& node : level.at) node.weight = 0.0f;  // masses first
    for (std::size_t i = 0; i < p.count(); ++i) {
      const float weight = p.point[i].weight, mass = weight > 0.0f ? 1.0f / weight : kPinnedMass * p.mass[i];
      const Parents& parents = level.parents[i];
      for (std::size_t k = 0; k < kParents; ++k) level.at[parents.node[k]].weight += parents.share[k] * mass;
    }
    for (std::size_t n = 0; n < level.node.size(); ++n) {
      float& weight = level.at[n].weight;
      weight = p.point[level.node[n]].weight > 0.0f ? 1.0f / weight : 0.0f;
    }
  }
}

void solve_coarse(const engine::Context& context, std::vector<CoarseLevel>& levels, Particles& particles) {
  for (CoarseLevel& level : levels) {
    load_nodes(particles, level);
    bool moved = false;
    for (int sweep = 0; sweep < level.sweeps; ++sweep) {
      if (!pull(level)) break;  // all within their limits: a further sweep would find the same
      moved = true;
    }
    if (!moved) continue;
    to_displacements(particles, level);
    carry(context, level, particles);
  }
}

}  // namespace bodice::cloth
