// Finds particles that self-contact moved into the body, after contact with the body was resolved.
#pragma once

#include <span>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/context.hpp>

#include "contact/continuous_contact.hpp"

namespace bodice::inline v0_1::cloth {

/// The body in the state in which a substep resolved contact with it. Without a body, nothing sinks.
struct ResolvedBody {
  const collision::Collider* collider = nullptr;
  const BodyMotion* motion = nullptr;
  float thickness_m = 0.0f;  ///< distance that particles keep
  /// The least distance to which self-contact may move them; negative: inside the body.
  float least_m = 0.0f;
  float remaining = 0.0f;  ///< share of the frame that is left after the substep
};

/// A plane that keeps a particle out of the body, because the particle must stay in front of it. x, y, z are
/// the plane's unit normal. `weight` is its distance along the normal from where contact with the body left
/// the particle. A zero normal means that there is no guard.
using Guard = Point;

inline bool is_guarded(const Guard& guard) {
  return guard.x != 0.0f || guard.y != 0.0f || guard.z != 0.0f;
}

/// Sets the guard of each particle of `moved` that sank, and returns whether any did. A particle sank if it
/// is nearer to the body at `now` than `least_m`, and nearer than at `resolved`. Its first guard is parallel
/// to the surface below `resolved`. If a guarded particle sinks again, because the surface bends or faces
/// itself, its next guard is parallel to the surface below `now`. All lists but `moved` have one element for
/// each particle (#P). Cost: two queries a particle of `moved`.
bool guard_sunk(const engine::Context& context, const ResolvedBody& body, std::span<const Index> moved,
                std::span<const Point> resolved, std::span<const Point> now, std::span<Guard> guard);

/// Moves a particle to the front of its guard's plane, if it is behind it.
inline Float4 guarded(Float4 now, const Point& resolved, const Guard& guard) {
  const float along = dot(now - load(resolved), load(guard)) - guard.weight;
  return along < 0.0f ? now - along * xyz(load(guard)) : now;
}

}  // namespace bodice::cloth
