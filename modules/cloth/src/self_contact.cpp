#include "self_contact.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "tiny.hpp"

namespace bodice::cloth {
namespace {

constexpr float kSearch = 2.0f;  // radii: pairs this near may meet within the frame

// A particle that lies on the body gives way this much less to another layer: what the body will take back
// would let the outer layer sink into the inner one.
constexpr float kTouchingMass = 8.0f;

constexpr double kFresh = 0.4;  // radii the fastest may travel between searches; half is the bound

float distance2(const Point& a, const Point& b) {
  const Float4 d = load(a) - load(b), dd = d * d;
  return dd[0] + dd[1] + dd[2];
}

void offer(const Ring& ring, SelfContact& s, Index i, Index j) {
  const auto joined = ring.of(i);
  if (s.close_count[i] == kMaxClose || std::find(joined.begin(), joined.end(), j) != joined.end()) return;
  const std::size_t at = i * kMaxClose + s.close_count[i]++;
  s.close[at] = j;
  s.close_m[at] = std::min(s.radius_m, std::sqrt(distance2(s.rest[i], s.rest[j])));
}

void find_close(const Ring& ring, const Particles& p, SelfContact& s, Index i) {
  const Point& own = p.point[i];
  const float reach2 = kSearch * kSearch * s.radius_m * s.radius_m;
  s.close_count[i] = 0;
  s.grid.visit_near(own, [&](const CellGrid::Entry& other) {
    if (other.particle != i && distance2(own, other.at) <= reach2) offer(ring, s, i, other.particle);
  });
}

float yielding(const Particles& p, const std::vector<std::uint8_t>& touching, Index i) {
  return touching[i] ? p.point[i].weight / kTouchingMass : p.point[i].weight;
}

Float4 correction(const Particles& p, const std::vector<std::uint8_t>& touching, const SelfContact& s,
                  Index i) {
  const float own = yielding(p, touching, i);
  const Float4 at = load(p.point[i]);
  Float4 sum = splat(0.0f);
  float pushes = 0.0f;
  for (std::size_t k = i * kMaxClose; k < i * kMaxClose + s.close_count[i]; ++k) {
    const Index j = s.close[k];
    const float length2 = distance2(p.point[i], p.point[j]);
    if (length2 >= s.close_m[k] * s.close_m[k]) continue;
    const float length = std::sqrt(length2 + kTinyLength2);
    const float share = own / (own + yielding(p, touching, j) + kTinyWeight);
    sum += share * (s.close_m[k] - length) / length * xyz(at - load(p.point[j]));
    pushes += 1.0f;
  }
  return pushes > 1.0f ? sum / pushes : sum;
}

}  // namespace

SelfContact make_self_contact(const Particles& particles, double radius_m) {
  SelfContact s;
  const std::size_t count = particles.count();
  s.radius_m = static_cast<float>(radius_m);
  for (std::size_t i = 0; i < count; ++i)
    s.rest.push_back({particles.x[i], particles.y[i], particles.z[i], 0});
  s.grid = CellGrid(kSearch * s.radius_m, count);
  s.close_count.assign(count, 0), s.active.assign(count, 0), s.move.assign(count, {});
  s.close.assign(count * kMaxClose, 0), s.close_m.assign(count * kMaxClose, 0.0f);
  return s;
}

void find_close_pairs(const engine::Context& context, const Ring& ring, const Particles& particles,
                      SelfContact& self) {
  if (!(self.radius_m > 0.0f) || self.travel_m < kFresh * static_cast<double>(self.radius_m)) return;
  self.travel_m = 0.0;
  self.grid.fill({particles.point.data(), particles.count()});
  engine::parallel_for(context, particles.count(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) find_close(ring, particles, self, static_cast<Index>(i));
  });
  self.active_count = 0;
  for (Index i = 0; i < particles.count(); ++i)
    if (self.close_count[i] > 0) self.active[self.active_count++] = i;
}

void push_apart(const engine::Context& context, const std::vector<std::uint8_t>& touching, SelfContact& self,
                Particles& particles) {
  engine::parallel_for(context, self.active_count, kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      store(self.move[k], correction(particles, touching, self, self.active[k]));
  });
  engine::parallel_for(context, self.active_count, kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      Point& point = particles.point[self.active[k]];
      store(point, load(point) + load(self.move[k]));
    }
  });
}

}  // namespace bodice::cloth
