#include "pairs/face_pair.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bodice::inline v0_1::cloth {
namespace {

// The square of the least cosine between the normals of a flat patch and their mean: 60 degrees.
constexpr float kFlat2 = 0.25f;
// Sine and cosine of 75 degrees, the angle to the mean normal that no normal can reach before the patch is
// tested again. With angles of 90 degrees a patch may lie over itself.
constexpr float kSinMost = 0.9659258f, kCosMost = 0.2588190f;

Float4 middle(const Float4 (&corner)[3]) {
  return (corner[0] + corner[1] + corner[2]) * (1.0f / 3.0f);
}

// Whether all corners but the common ones are farther than `reach_m` from a plane through the common ones,
// those of a in front of it and those of b behind it.
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

// A direction from b to a, as seen from their common corner or edge.
Float4 between(const FacePair& p) {
  const Float4 at = p.a[p.shared[0][0]];
  Float4 to_a = middle(p.a) - at, to_b = middle(p.b) - at;
  if (p.common == 2) {
    const Float4 edge = unit(p.a[p.shared[1][0]] - at);
    to_a -= dot(to_a, edge) * edge, to_b -= dot(to_b, edge) * edge;
  }
  return unit(to_a) - unit(to_b);
}

// The normal of a triangle, as long as twice its area, and the square of its longest edge.
struct FaceNormal {
  Float4 normal;
  float edge2;
};

FaceNormal normal_of(const Face& f, std::span<const Point> at) {
  const Float4 a = xyz(load(at[f.particle[0]])), ab = xyz(load(at[f.particle[1]])) - a,
               ac = xyz(load(at[f.particle[2]])) - a, bc = ac - ab;
  const Float4 normal = cross(ab, ac);
  return {f.turned ? -normal : normal, std::max({dot(ab, ab), dot(ac, ac), dot(bc, bc)})};
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

float least_apart(const FacePair& p) {
  const Float4 along = middle(p.a) - middle(p.b);
  const float low = std::min({dot(along, p.a[0]), dot(along, p.a[1]), dot(along, p.a[2])}),
              high = std::max({dot(along, p.b[0]), dot(along, p.b[1]), dot(along, p.b[2])});
  return low > high ? (low - high) / std::sqrt(dot(along, along)) : 0.0f;
}

bool are_clear(const FacePair& p, float reach_m) {
  return p.common == 3 || are_on_sides(p, between(p), reach_m);
}

float travel_while_flat(const ContactMesh& mesh, std::size_t leaf, std::size_t other,
                        std::span<const Point> at) {
  FaceNormal faces[2 * kLeaf];
  Float4 mean = splat(0.0f);
  std::size_t count = 0;
  for (const Face& f : mesh.faces_of(leaf)) mean += (faces[count++] = normal_of(f, at)).normal;
  if (other != leaf)
    for (const Face& f : mesh.faces_of(other)) mean += (faces[count++] = normal_of(f, at)).normal;
  float cosine2 = 1.0f, height2 = std::numeric_limits<float>::max();  // the least of each
  for (std::size_t k = 0; k < count; ++k) {
    const float along = dot(faces[k].normal, mean), area2 = dot(faces[k].normal, faces[k].normal);
    if (!(along > 0.0f)) return 0.0f;
    cosine2 = std::min(cosine2, along * along / (area2 * dot(mean, mean)));
    height2 = std::min(height2, area2 / faces[k].edge2);
  }
  if (!(cosine2 >= kFlat2)) return 0.0f;
  // The sine of the angle by which the patch may still turn, from the sine of a difference of angles.
  const float sine = kSinMost * std::sqrt(cosine2) - kCosMost * std::sqrt(1.0f - cosine2);
  return sine * std::sqrt(height2);
}

}  // namespace bodice::cloth
