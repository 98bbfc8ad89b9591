#include "contact/clearance_cache.hpp"

#include <algorithm>

#include <bodice/engine/parallel.hpp>

#include "base/tolerances.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

constexpr float kTravelSpare = 2.0f;   // the query band is this multiple of the expected travel, because
                                       // constraints pull some particles faster
constexpr double kMostTravel_m = 1e6;  // bounds the query band
// If fewer than one cluster in kWorthQueries is clear, the queries of clusters cost more than they save, and
// are left out for kWait frames.
constexpr std::size_t kWorthQueries = 8;
constexpr int kWait = 15;

/// The query band: distances beyond it need not be exact.
struct QueryBand {
  float touch_m = 0.0f;  // a nearer particle may touch without moving
  float free_m = 0.0f;   // width of the band beyond touch_m
};

// Queries the particles [begin, end), which are whole clusters, and sets how far each cluster may travel.
void query_run(const collision::Collider& body, const QueryBand& band, std::size_t begin, std::size_t end,
               Particles& p, ClearanceCache& c) {
  if (begin == end) return;
  const engine::Context alone{.executor = &engine::inline_executor()};
  const collision::Particles run{.count = end - begin, .x = &p.x[begin], .y = &p.y[begin], .z = &p.z[begin]};
  body.query(alone, run, std::span(c.nearest).subspan(begin, end - begin),
             {.within_m = band.touch_m + band.free_m});
  for (std::size_t i = begin; i < end; ++i) {
    float& free_m = c.free_m[i / kCluster];
    free_m = std::min(i % kCluster == 0 ? band.free_m : free_m, c.nearest[i].signed_distance - band.touch_m);
  }
}

// Queries all clusters without a touching particle. The others may touch, whatever a query gives.
void query_clusters(const engine::Context& context, const collision::Collider& body, const QueryBand& band,
                    std::span<const std::uint8_t> touching, Particles& p, ClearanceCache& c) {
  engine::parallel_for(context, p.count(), kCluster * 16, [&](std::size_t begin, std::size_t end) {
    std::size_t first = begin;  // where the current run begins
    for (std::size_t from = begin; from < end; from += kCluster) {
      const std::size_t to = std::min(from + kCluster, end);
      if (std::ranges::count(touching.subspan(from, to - from), 0) == static_cast<std::ptrdiff_t>(to - from))
        continue;
      query_run(body, band, first, from, p, c);
      c.free_m[from / kCluster] = 0.0f;
      first = to;
    }
    query_run(body, band, first, end, p, c);
  });
}

}  // namespace

ClearanceCache make_clearance_cache(std::size_t particles) {
  ClearanceCache c;
  c.free_m.assign(engine::block_count(particles, kCluster), 0.0f);
  c.nearest.resize(particles);
  return c;
}

void begin_clearance_frame(const engine::Context& context, const ContactFrame& frame,
                           std::span<const std::uint8_t> touching, Particles& particles, ClearanceCache& c) {
  const collision::Collider* const still_body = frame.still_body();
  const bool wait = c.frames_without > 0 && --c.frames_without > 0;
  if (wait || still_body == nullptr) {
    std::ranges::fill(c.free_m, 0.0f);
    return;
  }
  const Steepness& steepness = still_body->has_relief() ? kReliefSteepness : kPlainSteepness;
  const QueryBand band = {
      static_cast<float>(frame.thickness_m) + steepness.rise_m,
      kTravelSpare * steepness.slope * static_cast<float>(std::min(kMostTravel_m, frame.travel_m))};
  c.slope = steepness.slope;
  query_clusters(context, *still_body, band, touching, particles, c);
  const auto far = std::ranges::count_if(c.free_m, [](float free_m) { return free_m > 0.0f; });
  if (static_cast<std::size_t>(far) * kWorthQueries < c.free_m.size()) c.frames_without = kWait;
}

bool may_touch(const Particles& p, std::size_t begin, std::size_t end, ClearanceCache& c) {
  float& free_m = c.free_m[begin / kCluster];
  if (!(free_m > 0.0f)) return true;
  Float4 longest2 = splat(0.0f);
  for (std::size_t i = begin; i < end; i += 4) {
    const Float4 dx = load(&p.x[i]) - load(&p.old_x[i]), dy = load(&p.y[i]) - load(&p.old_y[i]),
                 dz = load(&p.z[i]) - load(&p.old_z[i]);
    longest2 = max(longest2, dx * dx + dy * dy + dz * dz);
  }
  const Float4 longest = square_root(longest2);
  free_m -= c.slope * std::max({longest[0], longest[1], longest[2], longest[3]});
  return !(free_m > 0.0f);
}

}  // namespace bodice::cloth
