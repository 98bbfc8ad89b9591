// The nearest response for a block. Each ellipsoid that a particle is below the clearance of adds the
// half-space beyond its tangent plane; by convexity a point in all of them is clear of all of those
// ellipsoids. Two half-spaces settle nearly all contacts; what is left goes to the exact side.
#if defined(BODICE_COLLISION_RESOLVE_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_RESOLVE_INL_
#undef BODICE_COLLISION_RESOLVE_INL_
#else
#define BODICE_COLLISION_RESOLVE_INL_
#endif

#include "simd/sample-inl.hpp"
#include "simd/smooth-inl.hpp"
#include "tolerances.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

constexpr int kPlainRounds = 4;
constexpr int kReliefRounds = 6;
constexpr float kOvershoot = static_cast<float>(kReliefOvershoot);
// Pushes longer than this many depths come from surfaces that nearly face each other: for the exact side.
constexpr float kLongestPush = static_cast<float>(collision::kLongestPush);
// A path shorter than this share of the shortest radius nearby neither passes through nor changes sides.
constexpr float kShortPath = static_cast<float>(kLongPath);

/// The half-spaces { x : n . x >= offset } in force; the second only where `two`.
struct Pair {
  V3 n1, n2;
  V offset1, offset2;
  M two;
};

/// The nearest point to p of both half-spaces: the four cases of the optimality conditions.
HWY_INLINE V3 project(const Pair& h, V3 p) {
  const V zero = hn::Zero(f);
  const V g1 = hn::Sub(h.offset1, dot(h.n1, p));
  const V g2 = hn::IfThenElse(h.two, hn::Sub(h.offset2, dot(h.n2, p)), all(-1e30f));
  const V cosine = hn::IfThenElse(h.two, dot(h.n1, h.n2), zero);
  const V sine2 = hn::Max(hn::NegMulAdd(cosine, cosine, all(1.0f)), all(1e-6f));
  const V rest1 = hn::NegMulAdd(cosine, g2, g1), rest2 = hn::NegMulAdd(cosine, g1, g2);
  const M both = hn::And(hn::Gt(rest1, zero), hn::Gt(rest2, zero));
  const M first = hn::And(hn::Gt(g1, zero), hn::Le(rest2, zero));
  const V alone1 = hn::IfThenElseZero(first, g1);
  const V alone2 = hn::IfThenElse(first, zero, hn::Max(g2, zero));
  const V push1 = hn::IfThenElse(both, hn::Div(rest1, sine2), alone1);
  const V push2 = hn::IfThenElse(both, hn::Div(rest2, sine2), alone2);
  return along(along(p, push1, h.n1), push2, h.n2);
}

struct Settled {
  V3 position;
  Pair contact;
  M open;  ///< not settled
  std::uint32_t rounds;
};

/// Plain ellipsoids: p in, a place clear of all candidates out.
HWY_INLINE Settled settle_plain(const Baked& baked, const Candidates& c, const Clearance& clearance, V3 p,
                                const Sample& first, M contact) {
  const V target = all(clearance.distance_m + clearance.slack_m);
  const V3 nothing = {hn::Zero(f), hn::Zero(f), hn::Zero(f)};
  Settled s;
  s.contact = {first.gradient, nothing, hn::Add(dot(first.gradient, p), hn::Sub(target, first.distance)),
               hn::Zero(f), hn::MaskFromVec(hn::Zero(f))};
  s.open = contact;
  s.position = p;
  for (s.rounds = 1; s.rounds <= kPlainRounds; ++s.rounds) {
    s.position = select(s.open, project(s.contact, p), s.position);
    const V below = hn::IfThenElse(s.open, all(clearance.distance_m), all(-1e30f));
    const Sample next = least_distance(baked, c, s.position, below);
    s.open = hn::And(s.open, hn::RebindMask(f, hn::Gt(next.owner, hn::Set(I(), -1))));
    if (hn::AllFalse(f, s.open)) break;
    // The newest violation takes the second place: rounds refine the pair of a crease.
    const V offset = hn::Add(dot(next.gradient, s.position), hn::Sub(target, next.distance));
    s.contact.n2 = select(s.open, next.gradient, s.contact.n2);
    s.contact.offset2 = hn::IfThenElse(s.open, offset, s.contact.offset2);
    s.contact.two = hn::Or(s.contact.two, s.open);
  }
  return s;
}

/// What surfaces that are not plain ellipsoids add to the clearance: nothing farther than this from every
/// ellipsoid is below it; and how far beyond the clearance is aimed at.
struct Bent {
  float reach_m, overshoot_m;
};

HWY_INLINE Bent bent_by(const ReliefTables* relief, const Clearance& clearance) {
  if (relief) return {relief->highest_m, kOvershoot * relief->blend_m};
  constexpr float kFillet = static_cast<float>(kFilletOvershoot);
  return {clearance.blend_m, std::min(kOvershoot * clearance.blend_m, kFillet * clearance.slack_m)};
}

/// F at p, of whichever kind.
HWY_INLINE Sample bent_distance(const Baked& baked, const ReliefTables* relief, const Candidates& c,
                                const Clearance& clearance, V3 p, V below) {
  if (relief) return relief_distance(baked, *relief, c, p, below);
  return smooth_distance(baked, clearance.blend_m, c, p, below);
}

/// Relief or a smooth union: Newton along the gradient of F.
HWY_INLINE Settled settle_bent(const Baked& baked, const ReliefTables* relief, const Candidates& c,
                               const Clearance& clearance, V3 p, const Sample& first, M contact) {
  const Bent bent = bent_by(relief, clearance);
  // The surface bends between steps; a share of the blending more lets Newton arrive from below.
  const V target = all(clearance.distance_m + clearance.slack_m + bent.overshoot_m);
  Settled s;
  s.open = contact;
  s.position = p;
  Sample at = first;
  for (s.rounds = 1; s.rounds <= kReliefRounds; ++s.rounds) {
    const V norm2 = hn::Max(dot(at.gradient, at.gradient), all(0.25f));
    const V step = hn::Div(hn::Sub(target, at.distance), norm2);
    s.position = select(s.open, along(s.position, step, at.gradient), s.position);
    const V below = hn::IfThenElse(s.open, all(clearance.distance_m + bent.reach_m), all(-1e30f));
    const Sample next = bent_distance(baked, relief, c, clearance, s.position, below);
    const M owned = hn::RebindMask(f, hn::Gt(next.owner, hn::Set(I(), -1)));
    at.gradient = select(hn::And(s.open, owned), next.gradient, at.gradient);
    at.distance = next.distance;
    s.open = hn::And(s.open, hn::And(owned, hn::Lt(next.distance, all(clearance.distance_m))));
    if (hn::AllFalse(f, s.open)) break;
  }
  s.contact = {unit(at.gradient), at.gradient, hn::Zero(f), hn::Zero(f), hn::MaskFromVec(hn::Zero(f))};
  return s;
}

/// Inward velocity removed, the rest slowed by Coulomb friction, restitution 0.
HWY_INLINE V3 corrected_velocity(Pair contact, float friction, V3 v) {
  contact.offset1 = contact.offset2 = hn::Zero(f);
  const V3 along_surface = project(contact, v);
  const V3 change = along_surface - v;
  const V impulse2 = dot(change, change), speed2 = dot(along_surface, along_surface);
  const V ratio = hn::Sqrt(hn::Div(impulse2, hn::Max(speed2, all(1e-30f))));
  return scaled(along_surface, hn::Max(hn::Zero(f), hn::NegMulAdd(all(friction), ratio, all(1.0f))));
}

/// Velocity of the body's material at x, carried by ellipsoid `owner`; lanes without owner read the first.
HWY_INLINE V3 surface_velocity(const SurfaceMotion* motion, VI owner, V3 x) {
  constexpr int kStride = sizeof(SurfaceMotion) / sizeof(float);
  const VI at = hn::Mul(hn::Max(owner, hn::Zero(I())), hn::Set(I(), kStride));
  const float* base = motion->turn;  // turn, then shift, without padding
  const V3 r0 = {hn::GatherIndex(f, base, at), hn::GatherIndex(f, base + 1, at),
                 hn::GatherIndex(f, base + 2, at)};
  const V3 r1 = {hn::GatherIndex(f, base + 3, at), hn::GatherIndex(f, base + 4, at),
                 hn::GatherIndex(f, base + 5, at)};
  const V3 r2 = {hn::GatherIndex(f, base + 6, at), hn::GatherIndex(f, base + 7, at),
                 hn::GatherIndex(f, base + 8, at)};
  const V3 shift = {hn::GatherIndex(f, base + 9, at), hn::GatherIndex(f, base + 10, at),
                    hn::GatherIndex(f, base + 11, at)};
  return V3{dot(r0, x), dot(r1, x), dot(r2, x)} + shift;
}

HWY_INLINE std::uint64_t bits(M m) {
  std::uint8_t bytes[8] = {};
  (void)hn::StoreMaskBits(f, m, bytes);
  std::uint64_t result;
  std::memcpy(&result, bytes, sizeof(result));
  return result;
}

/// Paths, relative to the ellipsoid that owns the place, longer than the limit. Without an owner any
/// ellipsoid may have come past.
HWY_INLINE M moved_far(const Block& block, const Clearance& clearance, int i, V3 p, VI owner, float limit_m) {
  V3 path = p - load3(block.sx + i, block.sy + i, block.sz + i);
  V limit = all(limit_m);
  if (clearance.motion) {
    const V3 carried = scaled(surface_velocity(clearance.motion, owner, p), all(clearance.dt_s));
    const M owned = hn::RebindMask(f, hn::Gt(owner, hn::Set(I(), -1)));
    path = select(owned, path - carried, path);
    limit = hn::IfThenElse(owned, limit, all(std::max(0.0f, limit_m - clearance.travel_m)));
  }
  return hn::Ge(dot(path, path), hn::Mul(limit, limit));
}

/// Undoing a particle's own path is not a push.
HWY_INLINE V own_path(const Block& block, int i, V3 p) {
  if (!block.has_safe) return hn::Zero(f);
  const V3 path = p - load3(block.sx + i, block.sy + i, block.sz + i);
  return hn::Sqrt(dot(path, path));
}

HWY_INLINE float shortest_radius(const Baked& baked, const Candidates& c) {
  float least = 1e30f;
  for (int i = 0; i < c.count; ++i)
    least = std::min(least, baked.cull.shortest[static_cast<std::size_t>(c.index[i])]);
  return least;
}

/// One vector of the block.
HWY_INLINE void resolve_vector(const Baked& baked, const ReliefTables* relief, const Candidates& c,
                               const Clearance& clearance, float short_path_m, int i, Block& block,
                               BlockResponse& out) {
  const V3 p = load3(block.x + i, block.y + i, block.z + i);
  const M valid = hn::FirstN(f, static_cast<std::size_t>(block.count - i));
  const V surface = all(clearance.distance_m);
  const bool plain = !relief && !(clearance.blend_m > 0.0f);
  const Sample first = plain ? least_distance(baked, c, p, surface)
                             : bent_distance(baked, relief, c, clearance, p,
                                             all(clearance.distance_m + bent_by(relief, clearance).reach_m));
  const M owned = hn::RebindMask(f, hn::Gt(first.owner, hn::Set(I(), -1)));
  M contact = hn::And(valid, hn::And(owned, hn::Lt(first.distance, surface)));
  M far = hn::MaskFromVec(hn::Zero(f));
  if (block.has_safe) far = hn::And(valid, moved_far(block, clearance, i, p, first.owner, short_path_m));
  contact = hn::AndNot(far, contact);
  out.hard |= bits(far) << i;
  if (hn::AllFalse(f, contact)) return;
  const Settled s = plain ? settle_plain(baked, c, clearance, p, first, contact)
                          : settle_bent(baked, relief, c, clearance, p, first, contact);
  V3 push = s.position - p;
  const V length2 = dot(push, push);
  const V depth = hn::Sub(surface, first.distance);
  const V longest = hn::Min(all(c.reach_m), hn::MulAdd(all(kLongestPush), depth, all(clearance.slack_m)));
  const M beyond = hn::Gt(length2, hn::Mul(longest, longest));
  const M hard = hn::And(contact, hn::Or(s.open, beyond));
  contact = hn::AndNot(hard, contact);
  const V limit = hn::Add(all(clearance.max_push_m), own_path(block, i, p));
  const M pending = hn::And(contact, hn::Gt(length2, hn::Mul(limit, limit)));
  const V share = hn::Div(limit, hn::Sqrt(hn::Max(length2, all(1e-30f))));
  const V3 position = select(pending, along(p, share, push), s.position);
  store3(select(contact, position, p), block.x + i, block.y + i, block.z + i);
  if (block.has_velocity) {
    const V3 v = load3(block.vx + i, block.vy + i, block.vz + i);
    V3 body = {hn::Zero(f), hn::Zero(f), hn::Zero(f)};
    if (clearance.motion) body = surface_velocity(clearance.motion, first.owner, p);
    const V3 slowed = corrected_velocity(s.contact, clearance.friction, v - body) + body;
    store3(select(contact, slowed, v), block.vx + i, block.vy + i, block.vz + i);
  }
  hn::Store(depth, f, out.depth + i);
  hn::Store(first.owner, I(), reinterpret_cast<std::int32_t*>(out.owner) + i);
  out.contact |= bits(contact) << i;
  out.pending |= bits(pending) << i;
  out.hard |= bits(hard) << i;
  out.iterations = std::max(out.iterations, std::min<std::uint32_t>(s.rounds, kReliefRounds));
}

HWY_INLINE bool resolve_lanes(const Baked& baked, const ReliefTables* relief, const Clearance& clearance,
                              Block& block, BlockResponse& out) {
  out.contact = out.pending = out.hard = 0;
  out.iterations = 0;
  Candidates candidates;
  const float beyond_m = relief ? relief->highest_m + relief->blend_m : 2.0f * clearance.blend_m;
  const float travel_m = block.has_safe ? clearance.travel_m : 0.0f;
  if (!cull_for_response(baked, block, clearance.distance_m + beyond_m + travel_m, candidates)) return false;
  out.radius_m = candidates.radius_m;
  if (candidates.count == 0) return true;
  const float short_path_m = kShortPath * shortest_radius(baked, candidates);
  const int width = static_cast<int>(hn::Lanes(f));
  for (int i = 0; i < block.count; i += width)
    resolve_vector(baked, relief, candidates, clearance, short_path_m, i, block, out);
  return true;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
