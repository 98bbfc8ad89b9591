#include "mesh/skin.hpp"

#include <algorithm>
#include <span>

#include <Eigen/Geometry>

#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::synth {
namespace {

using geometry::Index;

constexpr std::size_t kGrain = 256;     // vertices a task; each takes about ten microseconds
constexpr double kDesignEdge = 0.013;   // statures; it resolves the trunk's curves
constexpr int kDesignRelaxations = 24;  // iterations until the cage's unevenness is gone
constexpr int kFinalRelaxations = 3;    // iterations until the sampling's creases are gone
constexpr double kRelaxation = 0.6;     // share of the distance to the neighbors' mean

void project_all(const engine::Context& context, const Flesh& flesh, const PatchMesh& mesh, int steps,
                 std::vector<Vec3>& positions) {
  engine::parallel_for(context, positions.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      positions[v] = flesh.project(mesh.region[v], positions[v], steps);
  });
}

/// Moves each vertex toward the mean of its neighbors, and back onto the flesh.
void relax(const engine::Context& context, const Flesh& flesh, const PatchMesh& mesh, int iterations,
           std::vector<Vec3>& positions) {
  const Neighbors near(mesh);
  std::vector<Vec3> next(positions.size());
  for (int i = 0; i < iterations; ++i) {
    engine::parallel_for(context, positions.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        if (is_digit(mesh.region[v])) {  // relaxation would draw the few rings of a digit toward the palm
          next[v] = positions[v];
          continue;
        }
        Vec3 mean = Vec3::Zero();
        for (std::size_t k = near.start[v]; k < near.start[v + 1]; ++k) mean += positions[near.vertex[k]];
        mean /= static_cast<double>(near.start[v + 1] - near.start[v]);
        const Vec3 moved = positions[v] + kRelaxation * (mean - positions[v]);
        next[v] = flesh.project(mesh.region[v], moved, 1);
      }
    });
    positions.swap(next);
  }
}

}  // namespace

Neighbors::Neighbors(const PatchMesh& mesh) : start(mesh.at.size() + 1, 0) {
  // On a closed surface each edge occurs once in each direction: from a corner to the next one.
  for (const auto& quad : mesh.quads)
    for (const Index v : quad) ++start[v + 1];
  for (std::size_t v = 0; v + 1 < start.size(); ++v) start[v + 1] += start[v];
  vertex.resize(start.back());
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  for (const auto& quad : mesh.quads)
    for (int k = 0; k < 4; ++k) vertex[next[quad[k]]++] = quad[(k + 1) % 4];
}

Skin make_skin(const engine::Context& context, const Figure& figure, const Flesh& flesh) {
  Skin skin;
  skin.cage = make_cage(figure);
  const Patches patches(skin.cage);
  skin.mesh = patches.tessellate(counts_for(patches.class_lengths(skin.cage.positions), kDesignEdge));
  PatchMesh corners;  // the cage itself, as a mesh to sample from
  for (const Cage::Quad& quad : skin.cage.quads) {
    corners.counts.push_back({1, 1});
    corners.grid.push_back({static_cast<Index>(quad[0]), static_cast<Index>(quad[1]),
                            static_cast<Index>(quad[3]), static_cast<Index>(quad[2])});
  }
  for (const PatchPoint& at : skin.mesh.at)
    skin.positions.push_back(sample(corners, skin.cage.positions, at));
  project_all(context, flesh, skin.mesh, 4, skin.positions);
  relax(context, flesh, skin.mesh, kDesignRelaxations, skin.positions);
  project_all(context, flesh, skin.mesh, 2, skin.positions);
  return skin;
}

void settle(const engine::Context& context, const Flesh& flesh, Skin& skin, int relaxations) {
  project_all(context, flesh, skin.mesh, 2, skin.positions);
  relax(context, flesh, skin.mesh, relaxations, skin.positions);
  project_all(context, flesh, skin.mesh, 2, skin.positions);
}

double volume(const PatchMesh& mesh, const std::vector<Vec3>& positions) {
  double six = 0.0;
  for (const auto& q : mesh.quads) {
    const Vec3 &a = positions[q[0]], &b = positions[q[1]], &c = positions[q[2]], &d = positions[q[3]];
    six += a.dot(b.cross(c)) + a.dot(c.cross(d));
  }
  return six / 6.0;
}

std::vector<Vec3> sample_skin(const engine::Context& context, const Skin& skin, const Flesh& flesh,
                              const PatchMesh& mesh) {
  std::vector<Vec3> positions(mesh.at.size());
  engine::parallel_for(context, positions.size(), 4 * kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) positions[v] = sample(skin.mesh, skin.positions, mesh.at[v]);
  });
  project_all(context, flesh, mesh, 2, positions);
  relax(context, flesh, mesh, kFinalRelaxations, positions);
  project_all(context, flesh, mesh, 2, positions);
  return positions;
}

}  // namespace bodice::synth
