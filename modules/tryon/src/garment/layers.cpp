#include <bodice/tryon/layers.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/crossings.hpp>

#include "garment/outward.hpp"

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Index;
using geometry::Vec3;

constexpr double kDeepest_m = 0.04;      // how far below an inner garment a vertex may lie
constexpr int kRounds = 40;              // the most rounds that lift triangles which cross, by a gap each
constexpr std::size_t kLiftGrain = 256;  // vertices a task

/// The length by which a vertex must be lifted to lie over the inner garment, meters; 0 if that is not beside
/// it.
double lift_m(const geometry::MeshDistance& inner, const Vec3& p, const Vec3& out, double gap_m) {
  const auto near = inner.closest_point_within(p, kDeepest_m);
  if (!near) return 0.0;
  const Vec3 to = near->point - p;
  const double above_m = to.dot(out), aside_m = (to - above_m * out).norm();
  return aside_m <= std::abs(above_m) + gap_m ? std::max(0.0, above_m + gap_m) : 0.0;
}

void lift_over(const engine::Context& context, const geometry::MeshDistance& skin,
               const geometry::TriMesh& inner, double gap_m, geometry::TriMesh& outer) {
  const geometry::MeshDistance distance(context, inner);
  engine::parallel_for(context, outer.positions.size(), kLiftGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      Vec3& p = outer.positions[v];
      if (!p.allFinite()) continue;
      const Vec3 out = outward(skin, p);
      p += lift_m(distance, p, out, gap_m) * out;
    }
  });
}

geometry::TriMesh joined(const geometry::TriMesh& a, const geometry::TriMesh& b) {
  geometry::TriMesh both = a;
  const auto first = static_cast<Index>(a.positions.size());
  both.positions.insert(both.positions.end(), b.positions.begin(), b.positions.end());
  for (const auto& [i, j, k] : b.triangles) both.triangles.push_back({i + first, j + first, k + first});
  return both;
}

/// The vertices of the triangles of `outer` that cross `inner`.
std::set<Index> crossing_vertices(const geometry::TriMesh& inner, const geometry::TriMesh& outer) {
  const geometry::TriMesh both = joined(inner, outer);
  const std::size_t first = inner.triangles.size();
  std::set<Index> found;
  for (const auto& [s, t] : geometry::find_crossings(both.positions, both.triangles))
    if (s < first && t >= first)
      found.insert(outer.triangles[t - first].begin(), outer.triangles[t - first].end());
  return found;
}

void lay_over(const engine::Context& context, const geometry::MeshDistance& skin,
              const geometry::TriMesh& inner, double gap_m, geometry::TriMesh& outer) {
  lift_over(context, skin, inner, gap_m, outer);
  for (int round = 0; round < kRounds; ++round) {
    const std::set<Index> crossing = crossing_vertices(inner, outer);
    if (crossing.empty()) return;
    for (const Index v : crossing) outer.positions[v] += gap_m * outward(skin, outer.positions[v]);
  }
}

// The name of a garment from a file is its path. The file's name with or without extension matches as well.
bool is_named(const WornGarment& garment, const std::string& name) {
  const std::filesystem::path path = garment.name;
  return garment.name == name || path.filename() == name || path.stem() == name;
}

engine::Error bad_order(const std::string& name, const char* what, const std::vector<WornGarment>& garments) {
  std::string names;
  for (const WornGarment& g : garments) names += (names.empty() ? "" : ", ") + g.name;
  return {engine::ErrorCode::kInvalidArgument, "The order of layers " + std::string(what) + " " + name + ".",
          "Name some of these once each, from the body outward: " + names + "."};
}

}  // namespace

engine::Result<std::vector<WornGarment>> order_layers(const engine::Context& context,
                                                      const geometry::MeshDistance& skin,
                                                      const std::vector<std::string>& order,
                                                      std::vector<WornGarment> garments, double gap_m) {
  std::vector<WornGarment*> layers;
  for (const std::string& name : order) {
    const auto found =
        std::ranges::find_if(garments, [&](const WornGarment& g) { return is_named(g, name); });
    if (found == garments.end()) return bad_order(name, "names no garment:", garments);
    if (std::ranges::find(layers, &*found) != layers.end()) return bad_order(name, "names twice:", garments);
    for (const WornGarment* inner : layers) lay_over(context, skin, inner->mesh, gap_m, found->mesh);
    layers.push_back(&*found);
  }
  return garments;
}

}  // namespace bodice::tryon
