// The clearance cache. Distances to the body are queried once a frame, and reduced by each cluster's travel.
// A cluster that cannot have reached the body skips the collider.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/context.hpp>

#include "base/contact_frame.hpp"
#include "base/particles.hpp"

namespace bodice::inline v0_1::cloth {

/// Particles in a cluster, which are neighbors on the cloth; as many as in a block of the collider.
inline constexpr std::size_t kCluster = 64;

/// How far each cluster may travel before one of its particles can touch the body.
struct ClearanceCache {
  /// #clusters: the travel that is left; where it is not above zero, the cluster may touch.
  std::vector<float> free_m;
  std::vector<collision::Contact> nearest;  ///< #P: scratch of the queries
  float slope = 1.0f;                       ///< bound on how much a meter of travel lowers a distance
  int frames_without = 0;                   ///< frames for which queries are still left out
};

/// The cache for this number of particles.
ClearanceCache make_clearance_cache(std::size_t particles);

/// Begins a frame: queries how far each cluster is from a body that stands still. In three cases no cluster
/// is queried, and each may touch: without a body, beside a moving body, and for some frames after most
/// clusters were near. Beside a moving body, resolve_moving() skips single particles instead. `touching` (#P)
/// states whether the body moved the particle in the substep before; clusters of such particles are not
/// queried.
void begin_clearance_frame(const engine::Context& context, const ContactFrame& frame,
                           std::span<const std::uint8_t> touching, Particles& particles,
                           ClearanceCache& clearance);

/// Whether the particles [begin, end) of a cluster, which moved from old_* to their positions, may touch the
/// body now. Subtracts the travel from the cache.
bool may_touch(const Particles& particles, std::size_t begin, std::size_t end, ClearanceCache& clearance);

}  // namespace bodice::cloth
