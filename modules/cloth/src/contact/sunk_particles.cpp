#include "contact/sunk_particles.hpp"

#include <algorithm>
#include <atomic>
#include <limits>

#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::cloth {
namespace {

constexpr float kAnyDistance_m = std::numeric_limits<float>::infinity();
constexpr std::size_t kSunkGrain = 128;  // particles a task
// A guarded particle may be nearer by this share of the thickness, because its guard is flat and the surface
// is not.
constexpr float kFlatness = 0.05f;

// Positions of particles, in the body's pose at the end of the frame, and their distances from it.
struct Probe {
  float x[kSunkGrain], y[kSunkGrain], z[kSunkGrain];
  collision::Contact contact[kSunkGrain];

  void query(const ResolvedBody& body, std::span<const Index> particles, std::span<const Point> at,
             float within_m) {
    for (std::size_t k = 0; k < particles.size(); ++k) {
      const Index i = particles[k];
      const Float4 p = load(at[i]) + body.remaining * load(body.motion->shift[i]);
      x[k] = p[0], y[k] = p[1], z[k] = p[2];
    }
    const engine::Context alone{.executor = &engine::inline_executor()};
    body.collider->query(alone, {.count = particles.size(), .x = x, .y = y, .z = z},
                         {contact, particles.size()}, {.within_m = within_m});
  }
};

}  // namespace

bool guard_sunk(const engine::Context& context, const ResolvedBody& body, std::span<const Index> moved,
                std::span<const Point> resolved, std::span<const Point> now, std::span<Guard> guard) {
  if (body.collider == nullptr) return false;
  std::atomic<bool> any{false};
  engine::parallel_for(context, moved.size(), kSunkGrain, [&](std::size_t begin, std::size_t end) {
    const std::span<const Index> batch = moved.subspan(begin, end - begin);
    Probe from, to;
    to.query(body, batch, now, body.thickness_m);
    from.query(body, batch, resolved, kAnyDistance_m);
    for (std::size_t k = 0; k < batch.size(); ++k) {
      Guard& own = guard[batch[k]];
      const bool was_guarded = is_guarded(own);
      const float allowed_m = std::min(from.contact[k].signed_distance, body.least_m);
      const float least_m = was_guarded ? allowed_m - kFlatness * body.thickness_m : allowed_m;
      if (!(to.contact[k].signed_distance < least_m)) continue;
      const float* const n = (was_guarded ? to : from).contact[k].normal;
      const Float4 normal =
          turned(Float4{n[0], n[1], n[2], 0.0f}, -body.remaining * load(body.motion->rotation[batch[k]]));
      const float along = was_guarded ? dot(load(now[batch[k]]) - load(resolved[batch[k]]), normal) : 0.0f;
      const float below_m = (was_guarded ? to : from).contact[k].signed_distance;
      own = {normal[0], normal[1], normal[2], along + allowed_m - below_m};
      any.store(true, std::memory_order_relaxed);
    }
  });
  return any.load();
}

}  // namespace bodice::cloth
