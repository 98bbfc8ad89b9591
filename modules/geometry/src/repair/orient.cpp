#include "repair/orient.hpp"

#include <cmath>
#include <numeric>
#include <span>

#include <bodice/geometry/disjoint_sets.hpp>

namespace bodice::inline v0_1::geometry {
namespace {

// Fraction of area^1.5 below which a patch's volume is noise. It is .094 for a sphere, about .02 for a body,
// and .01 for an open skirt seen from its centroid.
constexpr double kFlatPatch = 1e-6;

/// Whether two triangles run along a shared edge in opposite directions, as consistent neighbors do.
bool consistent(const Triangle& a, const Triangle& b, const MeshEdges::Ends& ends) {
  auto forward = [&](const Triangle& t) {
    for (int k = 0; k < 3; ++k)
      if (t[k] == ends[0] && t[(k + 1) % 3] == ends[1]) return true;
    return false;
  };
  return forward(a) != forward(b);
}

/// The triangles reachable from `seed`, with flips relative to it.
std::vector<Index> grow_patch(const TriMesh& mesh, const MeshEdges& edges, Index seed,
                              std::vector<bool>& seen, std::vector<bool>& flip) {
  std::vector<Index> patch{seed};
  seen[seed] = true;
  for (std::size_t next = 0; next < patch.size(); ++next) {
    const Index t = patch[next];
    for (int k = 0; k < 3; ++k) {
      const Index other = edges.across(t, k);
      if (other == kNoIndex || seen[other]) continue;
      seen[other] = true;
      const MeshEdges::Ends& ends = edges.ends[edges.of_triangle[t][k]];
      const bool agree = consistent(mesh.triangles[t], mesh.triangles[other], ends);
      flip[other] = agree ? flip[t] : !flip[t];
      patch.push_back(other);
    }
  }
  return patch;
}

/// Whether the patch, with the chosen flips, faces inward.
bool inward(const TriMesh& mesh, std::span<const Index> patch, const std::vector<bool>& flip) {
  Vec3 centroid = Vec3::Zero();
  double twice_area = 0.0;
  const Vec3 near = mesh.corner(patch.front(), 0);
  for (Index t : patch) {
    const double weight = area_vector(mesh, t).norm();
    centroid +=
        weight * ((mesh.corner(t, 0) - near) + (mesh.corner(t, 1) - near) + (mesh.corner(t, 2) - near)) / 3.0;
    twice_area += weight;
  }
  if (twice_area > 0.0) centroid /= twice_area;
  double six_volumes = 0.0;
  std::size_t flipped = 0;
  for (Index t : patch) {
    const double six = (mesh.corner(t, 0) - near - centroid).dot(area_vector(mesh, t));
    six_volumes += flip[t] ? -six : six;
    flipped += flip[t];
  }
  if (std::abs(six_volumes) > 6.0 * kFlatPatch * std::pow(0.5 * twice_area, 1.5)) return six_volumes < 0.0;
  return 2 * flipped > patch.size();
}

/// Whether neighbors agree as they are.
bool agree_all(const TriMesh& mesh, const MeshEdges& edges) {
  for (Index e = 0; e < edges.ends.size(); ++e) {
    if (!edges.joins_two(e)) continue;
    const auto [a, b] = edges.triangles[e];
    if (!consistent(mesh.triangles[a], mesh.triangles[b], edges.ends[e])) return false;
  }
  return true;
}

/// The patches of a mesh, each with its triangles ascending.
struct Patches {
  std::vector<Index> offset, triangle;
};

Patches find_patches(const TriMesh& mesh, const MeshEdges& edges) {
  const auto count = static_cast<Index>(mesh.triangles.size());
  DisjointSets sets(count);
  for (Index e = 0; e < edges.ends.size(); ++e)
    if (edges.joins_two(e)) sets.unite(edges.triangles[e][0], edges.triangles[e][1]);
  Patches patches{std::vector<Index>(count + 1, 0), std::vector<Index>(count)};
  for (Index t = 0; t < count; ++t) ++patches.offset[sets.find(t) + 1];
  std::partial_sum(patches.offset.begin(), patches.offset.end(), patches.offset.begin());
  std::vector<Index> next(patches.offset.begin(), patches.offset.end() - 1);
  for (Index t = 0; t < count; ++t) patches.triangle[next[sets.find(t)]++] = t;
  return patches;
}

/// The orientation of a mesh where neighbors agree: patches are turned as wholes.
Orientation turn_patches(const TriMesh& mesh, const MeshEdges& edges) {
  Orientation result{std::vector<bool>(mesh.triangles.size(), false)};
  const Patches patches = find_patches(mesh, edges);
  for (std::size_t i = 0; i + 1 < patches.offset.size(); ++i) {
    const std::span<const Index> patch(patches.triangle.data() + patches.offset[i],
                                       patches.offset[i + 1] - patches.offset[i]);
    if (patch.empty() || !inward(mesh, patch, result.flip)) continue;
    for (const Index t : patch) result.flip[t] = true;
    result.flipped += patch.size();
  }
  return result;
}

}  // namespace

Orientation choose_orientation(const TriMesh& mesh, const MeshEdges& edges) {
  if (agree_all(mesh, edges)) return turn_patches(mesh, edges);
  const std::size_t count = mesh.triangles.size();
  Orientation result{std::vector<bool>(count, false)};
  std::vector<bool> seen(count, false);
  for (Index seed = 0; seed < count; ++seed) {
    if (seen[seed]) continue;
    const std::vector<Index> patch = grow_patch(mesh, edges, seed, seen, result.flip);
    if (!inward(mesh, patch, result.flip)) continue;
    for (Index t : patch) result.flip[t] = !result.flip[t];
  }
  for (bool flip : result.flip) result.flipped += flip;
  for (Index e = 0; e < edges.ends.size(); ++e) {
    if (!edges.joins_two(e)) continue;
    const auto [a, b] = edges.triangles[e];
    const bool agree = consistent(mesh.triangles[a], mesh.triangles[b], edges.ends[e]);
    result.conflicts += agree != (result.flip[a] == result.flip[b]);
  }
  return result;
}

}  // namespace bodice::geometry
