#include "pairs/face_pair.hpp"

#include <algorithm>
#include <cmath>

namespace bodice::inline v0_1::cloth {
namespace {

// The square of the least cosine between the normals of a flat patch and their mean: 60 degrees.
constexpr float kFlat2 = 0.25f;
// Sine and cosine of the largest angle between a patch's mean normal and one of its normals until the patch
// is looked at again: 75 degrees. From 90 on, it may lie over itself.
constexpr float kSinMost = 0.9659258f, kCosMost = 0.2588190f;

Float4 middle(const Float4 (&corner)[3]) {
  return (corner[0] + corner[1] + corner[2]) * (1.0f / 3.0f);
}

bool are_apart(const FacePair& p, float reach_m) {
  const Float4 along = middle(p.a) - middle(p.b);
  const float low = std::min({dot(along, p.a[0]), dot(along, p.a[1]), dot(along, p.a[2])}),
              high = std::max({dot(along, p.b[0]), dot(along, p.b[1]), dot(along, p.b[2])});
  return low > high && (low - high) * (low - high) > reach_m * reach_m * dot(along, along);
}

// Whether all corners but common ones keep the distance from a plane through the common ones.
bool are_on_sides(const FacePair& p, Float4 direction, float reach_m) {
  const float wanted = reach_m * std::sqrt(dot(direction, direction) + kTinyLength2);
  const Float4 through = p.a[p.shared[0][0]];
  for (int k = 0; k < 3; ++k) {
    bool own[2] = {true, true};
    for (int s = 0; s < p.common; ++s) {
      own[0] = own[0] && p.shared[s][0] != k;
      own[1] = own[1] && p.shared[s][1] != k;
    }
    if (own[0] && !(dot(direction, p.a[k] - through) > wanted)) return false;
    if (own[1] && !(dot(direction, through - p.b[k]) > wanted)) return false;
  }
  return true;
}

// A direction that points from b to a, seen from what they share.
Float4 between(const FacePair& p) {
  const Float4 at = p.a[p.shared[0][0]];
  Float4 to_a = middle(p.a) - at, to_b = middle(p.b) - at;
  if (p.common == 2) {
    const Float4 edge = unit(p.a[p.shared[1][0]] - at);
    to_a -= dot(to_a, edge) * edge, to_b -= dot(to_b, edge) * edge;
  }
  return unit(to_a) - unit(to_b);
}

Float4 normal_of(const Face& f, std::span<const Point> at) {
  const Float4 a = load(at[f.particle[0]]);
  const Float4 normal = cross(load(at[f.particle[1]]) - a, load(at[f.particle[2]]) - a);
  return f.turned ? -normal : normal;
}

}  // namespace

FacePair face_pair(const Face& a, const Face& b, std::span<const Point> at) {
  FacePair out;
  for (int k = 0; k < 3; ++k) {
    out.a[k] = xyz(load(at[a.particle[k]])), out.b[k] = xyz(load(at[b.particle[k]]));
    for (int l = 0; l < 3; ++l) {
      if (a.particle[k] != b.particle[l]) continue;
      out.shared[out.common][0] = k, out.shared[out.common][1] = l;
      ++out.common;
    }
  }
  return out;
}

bool are_clear(const FacePair& p, float reach_m) {
  if (p.common == 3) return true;
  return p.common == 0 ? are_apart(p, reach_m) : are_on_sides(p, between(p), reach_m);
}

float turn_left(const ContactMesh& mesh, std::size_t leaf, std::size_t other, std::span<const Point> at) {
  Float4 normal[2 * kLeaf], mean = splat(0.0f);
  std::size_t count = 0;
  for (const Face& f : mesh.faces_of(leaf)) mean += normal[count++] = normal_of(f, at);
  if (other != leaf)
    for (const Face& f : mesh.faces_of(other)) mean += normal[count++] = normal_of(f, at);
  float least2 = 1.0f;  // the square of the least cosine
  for (std::size_t k = 0; k < count; ++k) {
    const float along = dot(normal[k], mean);
    if (!(along > 0.0f)) return 0.0f;
    least2 = std::min(least2, along * along / (dot(normal[k], normal[k]) * dot(mean, mean)));
  }
  if (!(least2 >= kFlat2)) return 0.0f;
  // The sine of what is left, by that of a difference of angles.
  return kSinMost * std::sqrt(least2) - kCosMost * std::sqrt(1.0f - least2);
}

}  // namespace bodice::cloth
