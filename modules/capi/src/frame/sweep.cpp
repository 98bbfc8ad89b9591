// Paths of particles against a collider: conservative advancement, all particles together.
// Based on: Brian Mirtich. Impulse-based Dynamic Simulation of Rigid Body Systems. 1996 (conservative
// advancement).
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/handles.hpp"
#include "base/structures.hpp"
#include "frame/collider.hpp"
#include "frame/host_contacts.hpp"
#include "frame/host_particles.hpp"

using namespace bodice;
using capi::invalid;
using capi::Outcome;

namespace {

constexpr float kTouch_m = 1e-4f;  ///< a particle this near to the thickness has arrived
/// Share of the free distance that a particle advances. Relief changes a distance by a little more than the
/// point moves; plain ellipsoids never do, but floats round.
constexpr float kAdvance = 0.9f;

/// Paths in the local frame, and where particles are on them.
struct Paths {
  float *from[3], *path[3], *at[3];
  float* fraction;
  std::size_t count;
  std::uint32_t* moving;  ///< the particles that go on; at[.][k] is where the one in moving[k] is

  void locate(std::size_t i, std::size_t k) const {
    for (int axis = 0; axis < 3; ++axis) at[axis][k] = from[axis][i] + fraction[i] * path[axis][i];
  }
  float length_m(std::size_t i) const { return std::hypot(path[0][i], path[1][i], path[2][i]); }
};

Paths make_paths(const capi::HostParticles& host, const double (&origin)[3], float* fraction, float* memory,
                 std::uint32_t* moving, std::size_t length) {
  Paths paths{{}, {}, {}, fraction, host.count, moving};
  for (int axis = 0; axis < 3; ++axis) {
    paths.from[axis] = memory + static_cast<std::size_t>(axis) * length;
    paths.path[axis] = memory + static_cast<std::size_t>(3 + axis) * length;
    paths.at[axis] = memory + static_cast<std::size_t>(6 + axis) * length;
  }
  for (std::size_t i = 0; i < host.count; ++i) {
    double start[3], end[3];
    host.safe.get(host.element(i), start);
    host.position.get(host.element(i), end);
    for (int axis = 0; axis < 3; ++axis) {
      paths.from[axis][i] = static_cast<float>(start[axis] - (host.is_local ? 0.0 : origin[axis]));
      paths.path[axis][i] = static_cast<float>(end[axis] - start[axis]);
    }
    fraction[i] = 0.0f;
    moving[i] = static_cast<std::uint32_t>(i);
    paths.locate(i, i);
  }
  return paths;
}

/// Advances the particles that move by what is free before them; returns how many go on. Each step is at
/// least kAdvance * kTouch_m and the next float at least, so that the paths come to an end.
std::size_t advance(const Paths& paths, std::size_t count, const collision::Contact* contacts,
                    float thickness_m) {
  std::size_t moving = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t i = paths.moving[k];
    const float free_m = contacts[k].signed_distance - thickness_m, length_m = paths.length_m(i);
    if (free_m <= kTouch_m) continue;
    const float before = paths.fraction[i];
    const float step = std::isfinite(free_m) ? kAdvance * free_m / length_m : 1.0f;
    const bool has_length = std::isfinite(length_m) && length_m > 0.0f;
    paths.fraction[i] =
        has_length ? std::min(1.0f, std::max(before + step, std::nextafter(before, 1.0f))) : 1.0f;
    if (paths.fraction[i] >= 1.0f) continue;
    paths.moving[moving] = i;
    paths.locate(i, moving++);
  }
  return moving;
}

Outcome check_paths(const capi::HostParticles& host, const float* fraction, float thickness_m) {
  if (!fraction) return invalid("The array of fractions is null.", "Pass a float for each particle.");
  if (!host.safe) return invalid("bodice_particles.safe has no arrays.", "Set it to where the paths begin.");
  if (!(thickness_m >= 0.0f && std::isfinite(thickness_m)))
    return invalid("The thickness is negative or not finite.", "Give meters, zero or more.");
  return {};
}

}  // namespace

bodice_status bodice_sweep(const bodice_collider* collider, const bodice_particles* particles,
                           float thickness_m, bodice_workspace* workspace, float* fraction,
                           const bodice_contacts* contacts) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(collider, "The collider"));
    capi::HostParticles host;
    BODICE_CHECK(capi::read_particles(particles, host));
    capi::HostContacts to;
    if (contacts) BODICE_CHECK(capi::read_contacts(contacts, host.count, to));
    if (host.count == 0) return {};
    BODICE_CHECK(check_paths(host, fraction, thickness_m));
    std::optional<bodice_workspace> own;
    bodice_workspace& memory = workspace ? *workspace : own.emplace(collider->context);
    double origin[3];
    for (int axis = 0; axis < 3; ++axis) origin[axis] = collider->collider.origin()[axis];
    const std::size_t length = (host.count + 15) / 16 * 16;
    const Paths paths = make_paths(host, origin, fraction, memory.numbers.reserve(9 * length),
                                   memory.element.reserve(host.count), length);
    collision::Contact* found = memory.contacts.reserve(host.count);
    const engine::Context context = collider->context->engine_context();
    const auto query = [&](std::size_t count) {
      collider->collider.query(context,
                               {.count = count, .x = paths.at[0], .y = paths.at[1], .z = paths.at[2]},
                               {found, count}, memory.engine);
    };
    for (std::size_t moving = host.count; moving > 0;) {
      query(moving);
      moving = advance(paths, moving, found, thickness_m);
    }
    for (std::size_t i = 0; i < host.count; ++i) paths.locate(i, i);
    query(host.count);
    capi::EngineContacts from{found, host.count, {0.0, 0.0, 0.0}, &collider->proxy};
    if (!host.is_local) std::copy_n(origin, 3, from.origin);
    if (contacts) write_contacts(context, from, to);
    return {};
  });
}
