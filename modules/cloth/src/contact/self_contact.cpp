#include "contact/self_contact.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include <bodice/engine/parallel.hpp>

#include "base/tolerances.hpp"

namespace bodice::cloth {
namespace {

// Distance in radii within which pairs are listed, because they may touch before the next search. The
// diagonal of a flat quad without an edge is 1.89 long; with a larger distance, smooth cloth would consist of
// pairs.
constexpr float kSearch = 1.8f;

// Size of a cell in search distances: several particles share the points gathered around it, and few of these
// are too far.
constexpr float kCell = 2.0f;

// A particle on the body counts as so many times heavier against another layer. The body undoes its part of
// the push, and the outer layer would sink into the inner one.
constexpr float kTouchingMass = 8.0f;

// The speed at which layers that begin too close move apart: a fold's width in a few frames.
constexpr float kRecovery_m_s = 0.1f;

constexpr std::size_t kBlock =
    256;  // particles a task: few particles of a garment touch, and those are neighbors
static_assert(kParticleGrain % kBlock == 0);

constexpr double kFresh = 0.3;  // travel of the fastest particle between searches, in radii; the bound is 0.4

// Friction and the recovery speed in a substep.
struct Rub {
  float friction;
  float recovery_m;
};

float distance2(const Point& a, const Point& b) {
  const Float4 d = load(a) - load(b), dd = d * d;
  return dd[0] + dd[1] + dd[2];
}

Joined join(Index own, std::span<const Index> ring) {
  Joined out;
  for (std::size_t k = 0; k < Joined::kFirst; ++k)
    out.id[k / 4][k % 4] = static_cast<int>(k + 1 < Joined::kFirst && k < ring.size() ? ring[k] : own);
  return out;
}

// Whether an edge joins two particles. It is called for every pair of near particles.
bool are_joined(const Joined& joined, const Ring& ring, Index i, Index j) {
  const auto id = static_cast<int>(j);
  const Int4 ids = {id, id, id, id};
  if (any((joined.id[0] == ids) | (joined.id[1] == ids))) return true;
  const std::span<const Index> all = ring.of(i);
  return all.size() >= Joined::kFirst && std::ranges::find(all, j) != all.end();
}

void offer(SelfContact& s, Index i, Index j) {
  if (s.close_count[i] == kMaxClose) return;
  const std::size_t at = s.close_count[i]++;
  ClosePairs::Four& four = s.close[i].four[at / 4];
  four.with[at % 4] = j;
  four.keep_m[at % 4] = std::min(s.radius_m, std::sqrt(distance2(s.rest[i], s.rest[j])));
}

constexpr std::size_t kMasked = 64;  // points in a mask of one word

// A mask of the points from `first` on that are near.
std::uint64_t near_ones(const PointRun& points, std::size_t first, Float4 x, Float4 y, Float4 z,
                        Float4 reach2) {
  const std::size_t count = std::min(kMasked, points.count - first);
  std::uint64_t near = 0;
  for (std::size_t k = 0; k < count; k += 4) {
    const Float4 dx = load(&points.x[first + k]) - x, dy = load(&points.y[first + k]) - y,
                 dz = load(&points.z[first + k]) - z;
    near |= std::uint64_t{lane_bits(dx * dx + dy * dy + dz * dz <= reach2)} << k;
  }
  return count < kMasked ? near & ((std::uint64_t{1} << count) - 1) : near;
}

// Lists the pairs of points `inside` a slot with those `round` it.
void find_close(const Ring& ring, const PointRun& inside, const PointRun& round, SelfContact& s) {
  const float reach_m = kSearch * s.radius_m;
  for (std::size_t k = 0; k < inside.count; ++k) __builtin_prefetch(&s.joined[inside.particle[k]]);
  for (std::size_t k = 0; k < inside.count; ++k) {
    const Index i = inside.particle[k];
    const Joined joined = s.joined[i];
    const Float4 x = splat(inside.x[k]), y = splat(inside.y[k]), z = splat(inside.z[k]);
    for (std::size_t first = 0; first < round.count; first += kMasked) {
      std::uint64_t near = near_ones(round, first, x, y, z, splat(reach_m * reach_m));
      for (; near != 0; near &= near - 1) {
        const Index j = round.particle[first + static_cast<std::size_t>(std::countr_zero(near))];
        if (!are_joined(joined, ring, i, j)) offer(s, i, j);
      }
    }
  }
}

float yielding(const Particles& p, const std::vector<std::uint8_t>& touching, Index i) {
  return touching[i] ? p.point[i].weight / kTouchingMass : p.point[i].weight;
}

float length_of(Float4 v) {
  const Float4 vv = v * v;
  return std::sqrt(vv[0] + vv[1] + vv[2] + kTinyLength2);
}

// The displacement of a particle in this substep.
Float4 traveled(const Particles& p, Index i) {
  return xyz(load(p.point[i])) - Float4{p.old_x[i], p.old_y[i], p.old_z[i], 0.0f};
}

// The correction between two particles that are too close. It undoes their approach in this substep, and
// removes the rest at a bounded speed, because a push becomes a velocity and a fold with fast sides never
// comes to rest. Friction is added as on the body.
Float4 part(const Particles& p, const Rub& rub, Index i, Index j, float near_m) {
  const Float4 apart = xyz(load(p.point[i]) - load(p.point[j]));
  const float length = length_of(apart);
  const Float4 normal = apart / length, slid = traveled(p, i) - traveled(p, j);
  const Float4 along = slid * normal;
  const float approach = along[0] + along[1] + along[2];
  const float push = std::min(near_m - length, std::max(-approach, 0.0f) + rub.recovery_m);
  const Float4 tangent = slid - approach * normal;
  const float held = std::min(1.0f, rub.friction * push / length_of(tangent));
  return push * normal - held * tangent;
}

// A mask of the pairs that are too close, out of four of which the first `taken` are pairs.
unsigned too_near(const Particles& p, const ClosePairs::Four& close, std::size_t taken, Index i) {
  const Float4 at = load(p.point[i]);
  Float4 d[4];
  for (std::size_t k = 0; k < 4; ++k) d[k] = at - load(p.point[close.with[k]]);
  transpose(d[0], d[1], d[2], d[3]);
  const Float4 keep_m = load(close.keep_m);
  const unsigned near = lane_bits(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < keep_m * keep_m);
  return taken < 4 ? near & ((1u << taken) - 1) : near;
}

Float4 correction(const Particles& p, const std::vector<std::uint8_t>& touching, const Rub& rub,
                  const SelfContact& s, Index i) {
  const float own = yielding(p, touching, i);
  Float4 sum = splat(0.0f);
  float pushes = 0.0f;
  const std::size_t count = s.close_count[i];
  for (std::size_t first = 0; first < count; first += 4) {
    const ClosePairs::Four& close = s.close[i].four[first / 4];
    for (unsigned near = too_near(p, close, count - first, i); near != 0; near &= near - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(near));
      const Index j = close.with[k];
      const float share = own / (own + yielding(p, touching, j) + kTinyWeight);
      sum += share * part(p, rub, i, j, close.keep_m[k]);
      pushes += 1.0f;
    }
  }
  return pushes > 1.0f ? sum / pushes : sum;
}

void list_active(const engine::Context& context, SelfContact& s) {
  engine::parallel_for(context, s.active.size(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; block += kBlock) {
      Index count = 0;
      for (std::size_t i = block; i < std::min(block + kBlock, end); ++i) {
        s.active[block + count] = static_cast<Index>(i);
        count += s.close_count[i] > 0;
      }
      s.active_count[block / kBlock] = count;
    }
  });
}

// Calls visit(k) for each used index k of `active`.
template <class Visit>
void for_each_active(const engine::Context& context, const SelfContact& s, Visit&& visit) {
  engine::parallel_for(context, s.active.size(), kBlock, [&](std::size_t begin, std::size_t) {
    for (std::size_t k = begin; k < begin + s.active_count[begin / kBlock]; ++k) visit(k);
  });
}

}  // namespace

SelfContact make_self_contact(const Particles& particles, const Ring& ring, double radius_m) {
  SelfContact s;
  const std::size_t count = particles.count();
  s.radius_m = static_cast<float>(radius_m);
  for (std::size_t i = 0; i < count; ++i) {
    s.rest.push_back({particles.x[i], particles.y[i], particles.z[i], 0});
    s.joined.push_back(join(static_cast<Index>(i), ring.of(i)));
  }
  s.grid = CellGrid(kCell * kSearch * s.radius_m, count);
  s.close_count.assign(count, 0), s.active.assign(count, 0), s.move.assign(count, {});
  s.active_count.assign(engine::block_count(count, kBlock), 0);
  s.close.assign(count, {});
  return s;
}

void find_close_pairs(const engine::Context& context, const Ring& ring, const Particles& particles,
                      SelfContact& self) {
  if (!(self.radius_m > 0.0f) || self.travel_m < kFresh * static_cast<double>(self.radius_m)) return;
  self.travel_m = 0.0;
  self.grid.fill(context, {particles.point.data(), particles.count()});
  std::ranges::fill(self.close_count, std::uint8_t{0});
  self.grid.for_each_slot(
      context, [&](const PointRun& inside, const PointRun& round) { find_close(ring, inside, round, self); });
  list_active(context, self);
}

void push_apart(const engine::Context& context, const std::vector<std::uint8_t>& touching, float friction,
                float substep_s, SelfContact& self, Particles& particles) {
  const Rub rub = {friction, kRecovery_m_s * substep_s};
  for_each_active(context, self, [&](std::size_t k) {
    store(self.move[k], correction(particles, touching, rub, self, self.active[k]));
  });
  for_each_active(context, self, [&](std::size_t k) {
    Point& point = particles.point[self.active[k]];
    store(point, load(point) + load(self.move[k]));
  });
}

}  // namespace bodice::cloth
