#include "faces/push_sample.hpp"

#include "base/tolerances.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

// The longest push of a sample that is left in this substep. The approach within the substep may be undone at
// once, greater depth at the recovery speed only. Pushes of neighboring samples count as well, because all
// together would otherwise throw the cloth.
float longest_push(const FaceSample& s, Float4 normal, const FaceSubstep& substep, const FaceContact& f,
                   const Particles& p) {
  const std::array<float, 3> weight = weights_of(s);
  Float4 path = -(substep.length_s / f.rules.frame_s) * vector_of(s.shift), pushed = splat(0.0f);
  for (int c = 0; c < 3; ++c) {
    const Index i = s.particle[c];
    path += weight[c] * (load(f.unpushed[i]) - Float4{p.old_x[i], p.old_y[i], p.old_z[i], 0.0f});
    pushed += weight[c] * (load(f.now[i]) - load(f.unpushed[i]));
  }
  const float nearer = std::max(0.0f, -dot(normal, path));
  return std::max(0.0f, kFromBody_m_s * substep.length_s + nearer - dot(normal, pushed));
}

// The normal of the body at a sample when the substep ends, before the rest of the frame turns the body.
Float4 normal_now(const FaceSample& s, float remaining, const FaceContact& f) {
  const Float4 normal = vector_of(s.normal);
  if (!f.motion.moving) return normal;
  const std::array<float, 3> weight = weights_of(s);
  Float4 turn = splat(0.0f);
  for (int c = 0; c < 3; ++c) turn += weight[c] * load(f.motion.rotation[s.particle[c]]);
  return turned(normal, -remaining * turn);
}

// Whether no free corner of a sample can leave the body within the frame. Contact of particles brings such
// corners out, and the sample with them. Many deep samples that push the same corners would throw them.
bool corners_are_deep(const FaceSample& s, const FaceContact& f) {
  const float deep_m = f.rules.keep_m - kFromBody_m_s * f.rules.frame_s;
  return std::ranges::all_of(s.particle, [&](Index i) {
    return !(f.now[i].weight > 0.0f) || f.nearest[i].signed_distance < deep_m;
  });
}

}  // namespace

bool push_out(const FaceSample& s, const FaceSubstep& substep, const Particles& p, FaceContact& f) {
  const float room = distance_at(s, in_end_pose(s, f.now, substep.remaining)) - s.keep_m;
  if (!(room < 0.0f)) return false;
  const std::array<float, 3> weight = weights_of(s);
  const std::array<float, 3> inverse_mass = {f.now[s.particle[0]].weight, f.now[s.particle[1]].weight,
                                             f.now[s.particle[2]].weight};
  const float yielding = yielding_of(weight, inverse_mass);
  if (!(yielding > 0.0f)) return true;
  const Float4 normal = normal_now(s, substep.remaining, f);
  float push = -room;
  if (push > kFromBody_m_s * substep.length_s) {
    if (corners_are_deep(s, f)) return false;
    push = std::min(push, longest_push(s, normal, substep, f, p));
  }
  const float ahead = dot(vector_of(s.normal), vector_of(s.shift));
  for (int c = 0; c < 3; ++c) {
    const Index i = s.particle[c];
    Point& point = f.now[i];
    const float by = push * point.weight * weight[c] / yielding;
    store(point, load(point) + by * normal);
    if (f.motion.moving) f.motion.along_pushes_m2[i] += by * ahead;
  }
  return true;
}

}  // namespace bodice::cloth
