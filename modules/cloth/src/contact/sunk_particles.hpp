// Finds particles that self-contact moved into the body, after contact with the body was resolved.
#pragma once

#include <span>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/context.hpp>

#include "contact/continuous_contact.hpp"

namespace bodice::inline v0_1::cloth {

/// The body as contact with it was resolved in a substep; without one, nothing sinks.
struct ResolvedBody {
  const collision::Collider* collider = nullptr;
  const BodyMotion* motion = nullptr;
  float thickness_m = 0.0f;  ///< distance that particles keep
  float least_m = 0.0f;      ///< distance up to which self-contact may move them; negative: into it
  float remaining = 0.0f;    ///< share of the frame that is left after the substep
};

/// What keeps a particle out of the body: it stays in front of a plane. `weight` is the plane's distance from
/// where contact with the body was resolved, along the normal x, y, z. Without a normal nothing keeps it.
using Guard = Point;

inline bool is_guarded(const Guard& guard) {
  return guard.x != 0.0f || guard.y != 0.0f || guard.z != 0.0f;
}

/// Sets the guard of each particle of `moved` that sank: at `now` it is nearer to the body than `least_m`,
/// and nearer than at `resolved`. The first guard of a particle is parallel to the surface below `resolved`.
/// Where a guarded particle sinks, because the surface bends or faces itself there, its next guard is
/// parallel to the surface below `now`. Returns whether any sank. All lists but `moved` are by particle.
/// Takes two queries a particle.
bool guard_sunk(const engine::Context& context, const ResolvedBody& body, std::span<const Index> moved,
                std::span<const Point> resolved, std::span<const Point> now, std::span<Guard> guard);

/// Moves a particle to the front of its guard's plane, if it is behind it.
inline Float4 guarded(Float4 now, const Point& resolved, const Guard& guard) {
  const float along = dot(now - load(resolved), load(guard)) - guard.weight;
  return along < 0.0f ? now - along * xyz(load(guard)) : now;
}

}  // namespace bodice::cloth
