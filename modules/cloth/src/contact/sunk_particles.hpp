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
  float remaining = 0.0f;    ///< share of the frame that is left after the substep
};

/// Sets `guard` (#P) of each particle of `moved` that sank: at `now` it is nearer to the body than the
/// thickness, and nearer than at `resolved`. Its guard is the body's normal at `resolved`, with weight 1;
/// others stay as they are. Returns whether any sank. Takes two queries a particle.
bool guard_sunk(const engine::Context& context, const ResolvedBody& body, std::span<const Index> moved,
                std::span<const Point> resolved, std::span<const Point> now, std::span<Point> guard);

/// Undoes what moved a guarded particle toward the body from where contact with it was resolved.
inline Float4 guarded(Float4 now, const Point& resolved, const Point& guard) {
  if (guard.weight == 0.0f) return now;
  const Float4 by = (now - load(resolved)) * load(guard);
  const float along = by[0] + by[1] + by[2];
  return along < 0.0f ? now - along * xyz(load(guard)) : now;
}

}  // namespace bodice::cloth
