// Pairs of triangles of two leaves with boxes that are near each other.
#pragma once

#include "selfcontact/contact_mesh.hpp"

namespace bodice::cloth {

/// The boxes of the triangles of a leaf, and of all of them.
struct LeafBoxes {
  Float4 low[kLeaf], high[kLeaf];
  Float4 all_low = {}, all_high = {};

  LeafBoxes(std::span<const Face> faces, std::span<const Point> at) {
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const auto& [a, b, c] = faces[k].particle;
      const Float4 p = xyz(load(at[a])), q = xyz(load(at[b])), r = xyz(load(at[c]));
      low[k] = min(min(p, q), r), high[k] = max(max(p, q), r);
      all_low = k == 0 ? low[k] : min(all_low, low[k]);
      all_high = k == 0 ? high[k] : max(all_high, high[k]);
    }
  }
};

/// Whether two boxes are nearer than `reach` along all axes.
inline bool are_near(Float4 low, Float4 high, Float4 other_low, Float4 other_high, Float4 reach) {
  return !any((low - other_high > reach) | (other_low - high > reach));
}

/// Calls visit(a, b) for each two triangles of two leaves, or of one, with boxes nearer than `reach_m`; a and
/// b are indices into ContactMesh::faces.
template <class Visit>
void for_each_near_face(const ContactMesh& mesh, std::span<const Point> at, std::size_t leaf,
                        std::size_t other, float reach_m, Visit&& visit) {
  const std::uint32_t first = mesh.face_begin[leaf], second = mesh.face_begin[other];
  const LeafBoxes a(mesh.faces_of(leaf), at), b(mesh.faces_of(other), at);
  const Float4 reach = splat(reach_m);
  const std::uint32_t in_a = mesh.face_begin[leaf + 1] - first, in_b = mesh.face_begin[other + 1] - second;
  for (std::uint32_t i = 0; i < in_a; ++i) {
    if (!are_near(a.low[i], a.high[i], b.all_low, b.all_high, reach)) continue;
    for (std::uint32_t j = leaf == other ? i + 1 : 0; j < in_b; ++j)
      if (are_near(a.low[i], a.high[i], b.low[j], b.high[j], reach)) visit(first + i, second + j);
  }
}

}  // namespace bodice::cloth
