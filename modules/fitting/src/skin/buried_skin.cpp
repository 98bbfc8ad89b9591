#include "skin/buried_skin.hpp"

#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::fitting {
namespace {

using geometry::Index;

constexpr int kSeedEvery = 8;  // one vertex in so many is evaluated at first
constexpr int kMaxPasses = 64;

enum class Burial : std::int8_t { kUndecided = -1, kFree = 0, kBuried = 1 };

/// The states of all vertices, evaluated by winding numbers or guessed from neighbors.
struct Search {
  const engine::Context& context;
  const geometry::TriMesh& mesh;
  const geometry::MeshDistance& distance;
  std::vector<geometry::Vec3> normals;
  double step_m;
  std::vector<Burial> state;        ///< #V
  std::vector<std::uint8_t> exact;  ///< #V: whether the state is evaluated

  void evaluate(const std::vector<Index>& vertices) {
    engine::parallel_for(context, vertices.size(), 32, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Index v = vertices[i];
        const geometry::Vec3 outside = mesh.positions[v] + step_m * normals[v];
        state[v] = distance.inside(outside) ? Burial::kBuried : Burial::kFree;
        exact[v] = 1;
      }
    });
  }

  /// Passes the known states along the edges until every reachable vertex has one.
  void spread() {
    for (int pass = 0; pass < kMaxPasses; ++pass) {
      bool changed = false;
      for (const geometry::Triangle& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) {
          const Index a = t[k], b = t[(k + 1) % 3];
          if (state[a] == Burial::kUndecided && state[b] != Burial::kUndecided)
            state[a] = state[b], changed = true;
          if (state[b] == Burial::kUndecided && state[a] != Burial::kUndecided)
            state[b] = state[a], changed = true;
        }
      if (!changed) break;
    }
  }

  /// Guessed vertices with normals that point at the back of other skin. A small patch may dip into another
  /// limb between the seeds, and a point off the skin lies behind its nearest triangle only if it is inside
  /// something.
  std::vector<Index> suspects() {
    const double reach_m = 50.0 * step_m;  // 17 mm on an adult: larger patches contain seeds
    std::vector<std::uint8_t> found(state.size(), 0);
    engine::parallel_for(context, state.size(), 256, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const geometry::Vec3 off = mesh.positions[v] + reach_m * normals[v];
        const auto hit = distance.closest_point_within(off, reach_m * (1.0 - 1e-3));
        found[v] = !exact[v] && hit && hit->normal.dot(off - hit->point) < 0.0;
      }
    });
    std::vector<Index> list;
    for (Index v = 0; v < found.size(); ++v)
      if (found[v]) list.push_back(v);
    return list;
  }

  /// Returns the vertices with a guessed state in triangles with corners of different state, and marks them
  /// as evaluated.
  std::vector<Index> doubtful() {
    std::vector<Index> found;
    for (const geometry::Triangle& t : mesh.triangles) {
      if (state[t[0]] == state[t[1]] && state[t[1]] == state[t[2]]) continue;
      for (const Index v : t)
        if (!exact[v]) found.push_back(v), exact[v] = 1;
    }
    return found;
  }
};

}  // namespace

std::vector<std::uint8_t> buried_triangles(const engine::Context& context, const geometry::TriMesh& mesh,
                                           const geometry::MeshDistance& distance, double stature_m) {
  const std::size_t n = mesh.positions.size();
  Search search{context,
                mesh,
                distance,
                geometry::vertex_normals(mesh),
                kStepOffSkin * stature_m,
                std::vector<Burial>(n, Burial::kUndecided),
                std::vector<std::uint8_t>(n, 0)};
  std::vector<Index> seeds;
  for (Index v = 0; v < n; v += kSeedEvery) seeds.push_back(v);
  search.evaluate(seeds);
  search.spread();
  search.evaluate(search.suspects());
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    const std::vector<Index> doubtful = search.doubtful();
    if (doubtful.empty()) break;
    search.evaluate(doubtful);
  }
  std::vector<std::uint8_t> buried(mesh.triangles.size());
  for (std::size_t t = 0; t < buried.size(); ++t)
    for (const Index v : mesh.triangles[t]) buried[t] |= search.state[v] == Burial::kBuried;
  return buried;
}

}  // namespace bodice::fitting
