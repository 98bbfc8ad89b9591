// Closest-point response of a batch: a query at the particles, a push of those below the clearance, and
// further queries and pushes until all are clear. What three half-spaces, or a few Newton steps, do not
// settle is left to the exact side.
#if defined(BODICE_COLLISION_RESOLVE_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_RESOLVE_INL_
#undef BODICE_COLLISION_RESOLVE_INL_
#else
#define BODICE_COLLISION_RESOLVE_INL_
#endif

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "model/fallback.hpp"
#include "model/tolerances.hpp"
#include "simd/broad/ranges-inl.hpp"
#include "simd/response/cutting_planes-inl.hpp"
#include "simd/response/velocity-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

// Longer pushes, in multiples of the depth, come from surfaces that nearly face each other and are left to
// the exact side.
constexpr float kLongestPush = static_cast<float>(collision::kLongestPush);
constexpr float kLongestPlainPush = static_cast<float>(collision::kLongestPlainPush);
constexpr float kShortPushOfSlack = static_cast<float>(kShortPush / kCertificate);
// A path shorter than this fraction of the least radius nearby neither passes through an ellipsoid nor
// changes sides.
constexpr float kShortPath = static_cast<float>(kLongPath);

/// The safe positions of these lanes; -1 reads lane 0.
HWY_INLINE V3 safe_positions_of(const ParticleBatch& batch, VI lanes) {
  return gather3(batch.sx, batch.sy, batch.sz, hn::Max(lanes, hn::Zero(I())));
}

/// Calls work for each lane of the mask with its particle, and whether the lane is in `which`.
template <class Work>
HWY_INLINE void for_particles(M mask, M which, const std::int32_t* lane, Work&& work) {
  const std::uint64_t chosen = bits(which);
  for (std::uint64_t left = bits(mask); left != 0; left &= left - 1) {
    const int k = std::countr_zero(left);
    work(lane[k], (chosen >> k & 1) != 0);
  }
}

HWY_INLINE M mask_of(const LaneBits& lanes, int i) {
  const std::uint64_t shifted = lanes.from(i);
  std::uint8_t bytes[8];
  std::memcpy(bytes, &shifted, sizeof(bytes));
  return hn::LoadMaskBits(f, bytes);
}

/// Resolves one batch against one surface, a policy of surface-inl.hpp.
template <class Surface>
class PushOut {
 public:
  /// Paths longer than `short_path_m` and pushes longer than `reach_m` are left to the exact side.
  HWY_INLINE PushOut(Surface& surface, const ParticleBatch& batch, BatchResponse& out, float short_path_m,
                     float reach_m)
      : surface_(surface),
        parameters_(surface.parameters),
        batch_(batch),
        out_(out),
        short_path_m_(short_path_m),
        reach_m_(reach_m) {}

  HWY_INLINE Status run();

 private:
  /// Flags paths longer than the limit, by the bound that holds for any ellipsoid.
  HWY_INLINE void flag_long_paths();
  /// First push of the particles that are below the clearance and have a short path; `contacts_` gets a bit
  /// for each. Those with a long path are left to the exact side.
  HWY_INLINE void push_first(int i);
  /// The lanes of `contact` without those that have a long path.
  HWY_INLINE M without_long_paths(M contact, int i, V3 p, VI owner);
  /// Writes the results of one vector of contacts; those with a long push or still below the clearance are
  /// left to the exact side.
  HWY_INLINE void write_responses(int i, M contact, V& deepest);
  /// Contacts with a push that the kernel does not settle.
  HWY_INLINE M unsettled(int i, V depth, V length2) const;
  /// The longest that a push is allowed to be: the path that it leads back against does not count.
  HWY_INLINE V longest_push(VI lanes, VI owner, V3 p, V3 push) const;
  /// The velocity after the contact, for particles that were pushed from p to `position`.
  HWY_INLINE V3 velocity_after(int i, VI lanes, V3 p, V3 position) const;

  Surface& surface_;
  const ResponseParameters& parameters_;
  const ParticleBatch& batch_;
  BatchResponse& out_;
  const float short_path_m_, reach_m_;
  InRange in_range_;
  BatchResults found_;
  PushState state_;
  PushedLanes pushed_;
  LaneBits contacts_;
};

template <class Surface>
HWY_INLINE void PushOut<Surface>::flag_long_paths() {
  const float travel_m = parameters_.motion ? parameters_.travel_m : 0.0f;
  const V limit = all(std::max(0.0f, short_path_m_ - travel_m));
  for (int i = 0; i < batch_.count; i += kWidth) {
    const V3 path =
        load3(batch_.x + i, batch_.y + i, batch_.z + i) - load3(batch_.sx + i, batch_.sy + i, batch_.sz + i);
    const M far = hn::Ge(dot(path, path), hn::Mul(limit, limit));
    out_.left_to_exact.add(bits(hn::And(far, lanes_below(i, batch_.count))), i);
  }
}

template <class Surface>
HWY_INLINE M PushOut<Surface>::without_long_paths(M contact, int i, V3 p, VI owner) {
  const VI lanes = hn::Load(I(), in_range_.lane + i);
  const M far = long_paths(p - safe_positions_of(batch_, lanes), parameters_, p, owner, short_path_m_);
  for_particles(contact, far, in_range_.lane + i,
                [&](int lane, bool is) { out_.left_to_exact.set(lane, is); });
  return hn::AndNot(far, contact);
}

template <class Surface>
HWY_INLINE void PushOut<Surface>::push_first(int i) {
  PlaneRows& plane = state_.plane[0];
  const V3 p = load3(in_range_.x + i, in_range_.y + i, in_range_.z + i);
  const V3 normal = load3(found_.gx + i, found_.gy + i, found_.gz + i);
  const V distance = hn::Load(f, found_.distance + i);
  const VI lanes = hn::Load(I(), in_range_.lane + i);
  M contact = hn::And(hn::RebindMask(f, hn::Gt(lanes, hn::Set(I(), -1))),
                      hn::Lt(distance, all(parameters_.clearance_m)));
  const VI proxy_index =
      hn::IfThenElseZero(hn::RebindMask(I(), contact), hn::Load(I(), found_.proxy_index + i));
  const VI nearest_one = hn::GatherIndex(I(), surface_.baked().internal_index.data(), proxy_index);
  const VI owner = hn::IfThenElse(hn::RebindMask(I(), contact), nearest_one, hn::Set(I(), -1));
  if (batch_.has_safe) contact = without_long_paths(contact, i, p, owner);
  hn::Store(owner, I(), plane.ellipsoid + i);
  store3(normal, plane.nx + i, plane.ny + i, plane.nz + i);
  const V target = surface_.target(owner);
  const V short_by = hn::Sub(target, distance);
  V3 x;
  if constexpr (Surface::kConvex) {
    x = add_scaled(p, short_by, normal);
  } else {
    const V beyond = hn::MulAdd(all(Surface::kFirstOvershoot), hn::Max(short_by, hn::Zero(f)), target);
    x = newton_step(p, distance, normal, hn::Load(f, found_.value + i), beyond);
  }
  store3(select(contact, x, p), state_.x + i, state_.y + i, state_.z + i);
  hn::Store(hn::Add(dot(normal, p), short_by), f, plane.offset + i);
  contacts_.add(bits(contact), i);
  pushed_.add(contact, lanes_from(i), x, owner);
}

template <class Surface>
HWY_INLINE V3 PushOut<Surface>::velocity_after(int i, VI lanes, V3 p, V3 position) const {
  const V3 v = gather3(batch_.vx, batch_.vy, batch_.vz, hn::Max(lanes, hn::Zero(I())));
  V3 body = {hn::Zero(f), hn::Zero(f), hn::Zero(f)};
  if (parameters_.motion)
    body = surface_velocity(parameters_.motion, hn::Load(I(), state_.plane[0].ellipsoid + i), p);
  const V3 relative = v - body;
  V3 along_surface;
  if constexpr (Surface::kConvex)
    along_surface = closest_velocity(state_, i, position, 4.0f * parameters_.slack_m, relative);
  else
    along_surface = closest_velocity(state_.plane[0].normal(i), relative);
  return corrected_velocity(along_surface, parameters_.friction, relative) + body;
}

template <class Surface>
HWY_INLINE M PushOut<Surface>::unsettled(int i, V depth, V length2) const {
  const V slack = all(parameters_.slack_m);
  V longest = hn::Min(all(reach_m_), hn::MulAdd(all(kLongestPush), depth, slack));
  if constexpr (Surface::kConvex) {
    const V short_m = all(kShortPushOfSlack * parameters_.slack_m);
    longest = hn::Min(longest, hn::Max(short_m, hn::MulAdd(all(kLongestPlainPush), depth, slack)));
  }
  return hn::Or(hn::Gt(length2, hn::Mul(longest, longest)), mask_of(state_.open, i));
}

template <class Surface>
HWY_INLINE V PushOut<Surface>::longest_push(VI lanes, VI owner, V3 p, V3 push) const {
  const V limit = all(parameters_.max_push_m);
  if (!batch_.has_safe) return limit;
  V3 path = p - safe_positions_of(batch_, lanes);
  if (parameters_.motion) path = path - carried(parameters_, p, owner);
  const M against = hn::Lt(dot(path, push), hn::Zero(f));
  return hn::Add(limit, hn::IfThenElseZero(against, hn::Sqrt(dot(path, path))));
}

template <class Surface>
HWY_INLINE void PushOut<Surface>::write_responses(int i, M contact, V& deepest) {
  const VI lanes = hn::Load(I(), in_range_.lane + i);
  const V3 p = load3(in_range_.x + i, in_range_.y + i, in_range_.z + i);
  const V3 pushed_to = load3(state_.x + i, state_.y + i, state_.z + i);
  const V3 push = pushed_to - p;
  const V length2 = dot(push, push);
  const V depth = hn::Sub(all(parameters_.clearance_m), hn::Load(f, found_.distance + i));
  const M hard = hn::And(contact, unsettled(i, depth, length2));
  for_particles(hard, hard, in_range_.lane + i, [&](int lane, bool) { out_.left_to_exact.set(lane, true); });
  contact = hn::AndNot(hard, contact);
  const V limit = longest_push(lanes, hn::Load(I(), state_.plane[0].ellipsoid + i), p, push);
  const M pending = hn::And(contact, hn::Gt(length2, hn::Mul(limit, limit)));
  V3 position = pushed_to;
  if (!hn::AllFalse(f, pending)) {
    const V share = hn::Div(limit, hn::Sqrt(hn::Max(length2, all(1e-30f))));
    position = select(pending, add_scaled(p, share, push), pushed_to);
  }
  const Pack pack(contact);
  const auto store = [&](V3 v, float* x, float* y, float* z) {
    pack.store(v.x, x + out_.count);
    pack.store(v.y, y + out_.count);
    pack.store(v.z, z + out_.count);
  };
  store(position, out_.x, out_.y, out_.z);
  if (batch_.has_velocity) store(velocity_after(i, lanes, p, pushed_to), out_.vx, out_.vy, out_.vz);
  pack.store(lanes, out_.lane + out_.count);
  pack.store(hn::Load(I(), state_.plane[0].ellipsoid + i), out_.owner + out_.count);
  out_.count += pack.count();
  out_.pending += static_cast<int>(hn::CountTrue(f, pending));
  deepest = hn::Max(deepest, hn::IfThenElseZero(contact, depth));
}

template <class Surface>
HWY_INLINE Status PushOut<Surface>::run() {
  Batch batch{.at = {batch_.x, batch_.y, batch_.z, batch_.count}, .cache = batch_.cache, .next = batch_.next};
  state_.plane[1].deactivate();
  state_.plane[2].deactivate();
  std::copy_n(out_.radius_m, kBlocks, batch.radius_m);
  const Status measured = surface_.measure_first(batch, in_range_, found_);
  if (measured != Status::kDone) return measured;
  std::copy_n(batch.radius_m, kBlocks, out_.radius_m);
  if (batch_.has_safe) flag_long_paths();
  for (int i = 0; i < in_range_.count; i += kWidth) push_first(i);
  if (contacts_.none()) return Status::kDone;
  CuttingPlanes<Surface> planes(surface_, in_range_, pushed_, state_);
  const Status pushed = planes.push_until_clear(batch_.has_velocity);
  if (pushed != Status::kDone) return pushed;
  V deepest = hn::Zero(f);
  for (int i = 0; i < in_range_.count; i += kWidth) {
    const M contact = mask_of(contacts_, i);
    if (!hn::AllFalse(f, contact)) write_responses(i, contact, deepest);
  }
  out_.deepest_m = hn::GetLane(hn::MaxOfLanes(f, deepest));
  out_.iterations = std::max(1u, state_.rounds);
  return Status::kDone;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
