#include "faces/own_side.hpp"

#include <algorithm>
#include <cmath>

namespace bodice::inline v0_1::cloth {
namespace {

// The least length of the mean of the normals at the particles. Where it is shorter, the particles lie around
// a limb.
constexpr float kAgreement = 0.5f;
// The least cosine between that mean and the normal of the surface that the ray meets.
constexpr float kFacing = 0.5f;
constexpr int kMostSteps = 8;
// kAbove: the height above the surface at the particles at which the ray begins, as a multiple of the
// distance to keep. kMetWithin: the distance at which it has met a surface, as a share of the sag.
constexpr float kAbove = 2.0f, kMetWithin = 0.1f;

struct Corner {
  const collision::Contact& contact;
  float weight;
};

// Calls visit(corner) for the particles of a sample with a weight above zero.
template <class Visit>
void for_each_corner(const FaceSample& s, const FaceContact& f, Visit&& visit) {
  const std::array<float, 3> weight = weights_of(s);
  for (int c = 0; c < 3; ++c)
    if (weight[c] > 0.0f) visit(Corner{f.nearest[s.particle[c]], weight[c]});
}

bool is_near(const Corner& corner, const FaceContact& f) {
  return corner.contact.signed_distance < f.rules.keep_m + f.rules.spacing_m;
}

// The ray that descends to a sample from outside, `length_m` long, against the unit vector `out`. `widest_m`
// is the largest distance from the sample to the surface at one of its particles.
struct Descent {
  Float4 out = {};
  float length_m = 0.0f, widest_m = 0.0f;
};

// The descent to a sample; its length is zero where the particles do not agree on a side.
Descent descent_to(const FaceSample& s, const FaceContact& f) {
  Float4 mean = splat(0.0f);
  bool all_near = true;
  for_each_corner(s, f, [&](const Corner& corner) {
    all_near = all_near && is_near(corner, f);
    mean += corner.weight * vector_of(corner.contact.normal);
  });
  const float agreement = std::sqrt(dot(mean, mean));
  if (!all_near || !(agreement > kAgreement)) return {};
  Descent descent{.out = mean / agreement};
  for_each_corner(s, f, [&](const Corner& corner) {
    const Float4 to_surface = vector_of(corner.contact.point) - vector_of(s.at);
    descent.length_m = std::max(descent.length_m, dot(descent.out, to_surface));
    descent.widest_m = std::max(descent.widest_m, std::sqrt(dot(to_surface, to_surface)));
  });
  descent.length_m += kAbove * f.rules.keep_m;
  return descent;
}

// The contact where the ray meets the body before it comes to the sample; without an ellipsoid where it does
// not.
collision::Contact meet(const collision::Collider& body, const Descent& descent, const FaceSample& s,
                        float within_m) {
  float left_m = descent.length_m;
  for (int step = 0; step <= kMostSteps && left_m > 0.0f; ++step) {
    const Float4 where = vector_of(s.at) + left_m * descent.out;
    const collision::Contact contact = body.query({where[0], where[1], where[2]});
    if (contact.signed_distance < within_m) return contact;
    left_m -= contact.signed_distance;
  }
  return {.ellipsoid = collision::kNoEllipsoid};
}

}  // namespace

bool is_on_its_side(const FaceSample& s, const FaceContact& f) {
  const Float4 normal = vector_of(s.normal), surface = vector_of(s.at) - s.distance_m * normal;
  bool holds = true;
  for_each_corner(s, f, [&](const Corner& corner) {
    if (!is_near(corner, f) || dot(normal, vector_of(corner.contact.normal)) >= 0.0f) return;
    // A surface ahead faces the sample's own across a gap; one behind is the other side of a limb.
    holds = holds && dot(normal, vector_of(corner.contact.point) - surface) > 0.0f;
  });
  return holds;
}

bool move_to_own_side(const collision::Collider& body, const FaceContact& f, FaceSample& sample) {
  const Descent descent = descent_to(sample, f);
  if (!(descent.length_m > 0.0f)) return false;
  const collision::Contact met = meet(body, descent, sample, kMetWithin * f.rules.sag_m);
  if (met.ellipsoid == collision::kNoEllipsoid) return false;
  const Float4 normal = vector_of(met.normal);
  const float depth_m = dot(normal, vector_of(met.point) - vector_of(sample.at));
  if (!(dot(normal, descent.out) > kFacing) || !(depth_m > 0.0f) || depth_m > descent.widest_m) return false;
  FaceSample taken = sample;
  set_contact(body, f.motion, met, f.rules.frame_s, taken);
  taken.distance_m = -depth_m;
  if (!is_on_its_side(taken, f)) return false;
  sample = taken;
  return true;
}

}  // namespace bodice::cloth
