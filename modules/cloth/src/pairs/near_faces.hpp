// Pairs of triangles of two leaves with boxes that are near each other.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "pairs/contact_mesh.hpp"

namespace bodice::inline v0_1::cloth {

/// The boxes of the triangles of a leaf, and of all of them. Lane k of an array is triangle k; lanes beyond
/// the leaf's triangles are empty.
struct LeafBoxes {
  alignas(32) float low[3][kLeaf], high[3][kLeaf];
  float all_low[3], all_high[3];

  LeafBoxes(std::span<const Face> faces, std::span<const Point> at) {
    Float4 least = splat(kFarOfBoxes_m), most = splat(-kFarOfBoxes_m);
    for (std::size_t k = 0; k < kLeaf; ++k) {
      Float4 face_low = splat(kFarOfBoxes_m), face_high = splat(-kFarOfBoxes_m);
      if (k < faces.size()) {
        const auto& [a, b, c] = faces[k].particle;
        const Float4 p = load(at[a]), q = load(at[b]), r = load(at[c]);
        face_low = min(min(p, q), r), face_high = max(max(p, q), r);
        least = min(least, face_low), most = max(most, face_high);
      }
      for (int axis = 0; axis < 3; ++axis) low[axis][k] = face_low[axis], high[axis][k] = face_high[axis];
    }
    for (int axis = 0; axis < 3; ++axis) all_low[axis] = least[axis], all_high[axis] = most[axis];
  }

 private:
  static constexpr float kFarOfBoxes_m = 1e30f;
};

/// A bit for each triangle of `boxes` that is nearer than `reach_m` along all axes to a box from `low` to
/// `high`. A position that is not a number is near everything.
inline unsigned near_bits(const LeafBoxes& boxes, const float (&low)[3], const float (&high)[3],
                          float reach_m) {
  static_assert(kLeaf == 8);
  unsigned near = 0;
  for (std::size_t half = 0; half < kLeaf; half += 4) {
    Int4 far = {};
    for (int axis = 0; axis < 3; ++axis) {
      const Float4 over = splat(low[axis]) - load(&boxes.high[axis][half]),
                   under = load(&boxes.low[axis][half]) - splat(high[axis]);
      far |= (over > splat(reach_m)) | (under > splat(reach_m));
    }
    near |= (~lane_bits(far) & 0xFu) << half;
  }
  return near;
}

/// The boxes of two leaves' triangles, or of one leaf's against each other.
class FaceBoxes {
 public:
  FaceBoxes(const ContactMesh& mesh, std::span<const Point> at, std::size_t leaf, std::size_t other)
      : same_(leaf == other),
        first_{mesh.face_begin[leaf], mesh.face_begin[other]},
        count_{mesh.face_begin[leaf + 1] - first_[0], mesh.face_begin[other + 1] - first_[1]},
        a_(mesh.faces_of(leaf), at),
        b_(mesh.faces_of(other), at) {}

  /// The least distance between boxes of different leaves, meters.
  float distance() const {
    Float4 least2 = splat(std::numeric_limits<float>::max());
    for (std::size_t k = 0; k < count_[0]; ++k)
      for (std::size_t half = 0; half < kLeaf; half += 4) {
        Float4 apart2 = splat(0.0f);
        for (int axis = 0; axis < 3; ++axis) {
          const Float4 over = splat(a_.low[axis][k]) - load(&b_.high[axis][half]),
                       under = load(&b_.low[axis][half]) - splat(a_.high[axis][k]);
          const Float4 apart = max(splat(0.0f), max(over, under));
          apart2 += apart * apart;
        }
        least2 = min(least2, apart2);
      }
    return std::sqrt(std::min({least2[0], least2[1], least2[2], least2[3]}));
  }

  /// Calls visit(a, b) for each two triangles with boxes nearer than `reach_m`; a and b are indices into
  /// ContactMesh::faces.
  template <class Visit>
  void for_each_near(float reach_m, Visit&& visit) const {
    const std::uint32_t all_of_b = (1u << count_[1]) - 1u;
    const unsigned in_reach = near_bits(a_, b_.all_low, b_.all_high, reach_m);
    for (std::uint32_t i = 0; i < count_[0]; ++i) {
      if ((in_reach >> i & 1u) == 0) continue;
      const float low[3] = {a_.low[0][i], a_.low[1][i], a_.low[2][i]};
      const float high[3] = {a_.high[0][i], a_.high[1][i], a_.high[2][i]};
      unsigned near = near_bits(b_, low, high, reach_m) & all_of_b;
      if (same_) near &= ~((2u << i) - 1u);  // each two triangles of one leaf once
      for (; near != 0; near &= near - 1u)
        visit(first_[0] + i, first_[1] + static_cast<std::uint32_t>(std::countr_zero(near)));
    }
  }

 private:
  bool same_;
  std::uint32_t first_[2], count_[2];  // in ContactMesh::faces
  LeafBoxes a_, b_;
};

}  // namespace bodice::cloth
