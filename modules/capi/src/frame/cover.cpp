// A collider that covers the host's skin.
#include <cmath>
#include <span>

#include "base/handles.hpp"
#include "frame/collider.hpp"
#include "frame/host_particles.hpp"

using namespace bodice;
using capi::invalid;
using capi::Outcome;

namespace {

/// The points in world coordinates.
void read_points(const capi::HostParticles& host, const geometry::Vec3& origin,
                 std::vector<geometry::Vec3>& points) {
  points.resize(host.count);
  for (std::size_t i = 0; i < host.count; ++i) {
    double at[3];
    host.position.get(host.element(i), at);
    points[i] = geometry::Vec3(at[0], at[1], at[2]);
    if (host.is_local) points[i] += origin;
  }
}

}  // namespace

bodice_status bodice_collider_cover(bodice_collider* collider, const bodice_particles* skin,
                                    float tolerance_m, std::size_t* uncovered) {
  return capi::guarded([&]() -> Outcome {
    if (uncovered) *uncovered = 0;
    BODICE_CHECK(capi::check_handle(collider, "The collider"));
    capi::HostParticles host;
    BODICE_CHECK(capi::read_particles(skin, host));
    if (!(tolerance_m >= 0.0f) || !std::isfinite(tolerance_m))
      return invalid("The tolerance of a cover is negative or not a number.", "0.0007 serves, in meters.");
    read_points(host, collider->collider.origin(), collider->skin);
    const collision::CoverReport report = collider->collider.cover(
        collider->context->engine_context(), collider->skin, {.tolerance_m = tolerance_m, .within = {}});
    if (uncovered) *uncovered = report.uncovered;
    return {};
  });
}
