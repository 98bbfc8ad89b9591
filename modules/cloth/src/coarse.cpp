// Based on: Matthias Mueller. Hierarchical Position Based Dynamics. 2008.
// Differs: nodes carry the mass of all that they stand for, so that momentum is kept; their constraints only
// pull (limits along the cloth), so that folds stay free; the corrections, not the positions, are
// interpolated.
#include "coarse.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "cloth_distance.hpp"
#include "pack.hpp"

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
  for (std::size_t k = 0; k < kParents; ++k) {
    if (share <= level.share[k][particle]) continue;
    std::swap(share, level.share[k][particle]);
    std::swap(node, level.parent[k][particle]);
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
  for (std::size_t k = 0; k < kParents; ++k)
    level.parent[k].assign(count, 0), level.share[k].assign(count, 0.0f);
  std::vector<Index> node_of(count, geometry::kNoIndex);
  for (Index n = 0; n < level.node.size(); ++n) node_of[level.node[n]] = n;
  tie_nodes(distance, spacing, slack, level, node_of);
  for (std::size_t i = 0; i < count; ++i) {
    float sum = 0.0f;
    for (const auto& share : level.share) sum += share[i];
    for (auto& share : level.share) share[i] /= sum;
  }
  for (auto* a : {&level.x, &level.y, &level.z, &level.weight}) a->assign(level.node.size(), 0.0f);
  return level;
}

void pull(CoarseLevel& level) {
  for (std::size_t c = 0; c < level.a.size(); ++c) {
    const Index a = level.a[c], b = level.b[c];
    const float dx = level.x[a] - level.x[b], dy = level.y[a] - level.y[b], dz = level.z[a] - level.z[b];
    const float length2 = dx * dx + dy * dy + dz * dz;
    if (length2 <= level.limit_m[c] * level.limit_m[c]) continue;
    const float length = std::sqrt(length2);
    const float scale =
        (length - level.limit_m[c]) / (length * (level.weight[a] + level.weight[b] + kTinyWeight));
    const float to_a = -scale * level.weight[a], to_b = scale * level.weight[b];
    level.x[a] += to_a * dx, level.y[a] += to_a * dy, level.z[a] += to_a * dz;
    level.x[b] += to_b * dx, level.y[b] += to_b * dy, level.z[b] += to_b * dz;
  }
}

// The nodes' displacements, shared out to the particles they carry.
void carry(const engine::Context& context, const CoarseLevel& level, Particles& p) {
  engine::parallel_for(context, p.count(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      float x = 0.0f, y = 0.0f, z = 0.0f;
      for (std::size_t k = 0; k < kParents; ++k) {
        const Index n = level.parent[k][i];
        x += level.share[k][i] * level.x[n];
        y += level.share[k][i] * level.y[n];
        z += level.share[k][i] * level.z[n];
      }
      const float follow = p.inverse_mass[i] > 0.0f ? p.weight[i] * p.mass[i] : 0.0f;
      p.x[i] += follow * x, p.y[i] += follow * y, p.z[i] += follow * z;
    }
  });
}

void load_nodes(const Particles& p, CoarseLevel& level) {
  for (std::size_t n = 0; n < level.node.size(); ++n) {
    const Index i = level.node[n];
    level.x[n] = p.x[i], level.y[n] = p.y[i], level.z[n] = p.z[i];
  }
}

void to_displacements(const Particles& p, CoarseLevel& level) {
  for (std::size_t n = 0; n < level.node.size(); ++n) {
    const Index i = level.node[n];
    level.x[n] -= p.x[i], level.y[n] -= p.y[i], level.z[n] -= p.z[i];
  }
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
    std::fill(level.weight.begin(), level.weight.end(), 0.0f);
    for (std::size_t i = 0; i < p.count(); ++i) {
      const float mass = p.weight[i] > 0.0f ? 1.0f / p.weight[i] : kPinnedMass * p.mass[i];
      for (std::size_t k = 0; k < kParents; ++k) level.weight[level.parent[k][i]] += level.share[k][i] * mass;
    }
    for (std::size_t n = 0; n < level.node.size(); ++n) {
      level.weight[n] = p.weight[level.node[n]] > 0.0f ? 1.0f / level.weight[n] : 0.0f;
    }
  }
}

void solve_coarse(const engine::Context& context, std::vector<CoarseLevel>& levels, Particles& particles) {
  for (CoarseLevel& level : levels) {
    load_nodes(particles, level);
    for (int sweep = 0; sweep < level.sweeps; ++sweep) pull(level);
    to_displacements(particles, level);
    carry(context, level, particles);
  }
}

}  // namespace bodice::cloth
