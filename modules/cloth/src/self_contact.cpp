// Based on: Matthias Teschner et al. Optimized Spatial Hashing for Collision Detection of Deformable Objects.
// 2003.
// Differs: buckets are filled by a counting sort, so that their order is that of the particles.
#include "self_contact.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <bodice/engine/parallel.hpp>
#include <bodice/engine/random.hpp>

#include "pack.hpp"

namespace bodice::cloth {
namespace {

constexpr float kSearch = 2.0f;  // radii: pairs this near may meet within the frame

// A particle that lies on the body gives way this much less to another layer: what the body will take back
// would let the outer layer sink into the inner one.
constexpr float kTouchingMass = 8.0f;

constexpr double kFresh = 0.4;  // radii the fastest may travel between searches; half is the bound

struct Cell {
  int x, y, z;
};

int to_cell(float value, float inverse_side) {
  return static_cast<int>(std::floor(std::clamp(value * inverse_side, -1e8f, 1e8f)));
}

Index bucket_of(const Cell& c, std::size_t buckets) {
  const auto x = static_cast<std::uint64_t>(static_cast<std::uint32_t>(c.x));
  const auto y = static_cast<std::uint64_t>(static_cast<std::uint32_t>(c.y));
  const auto z = static_cast<std::uint64_t>(static_cast<std::uint32_t>(c.z));
  return static_cast<Index>(engine::mix64(x * 73856093u ^ y * 19349663u ^ z * 83492791u) & (buckets - 1));
}

void sort_into_buckets(const Particles& p, float inverse_side, SelfContact& s) {
  const std::size_t buckets = s.cell_begin.size() - 1;
  std::fill(s.cell_begin.begin(), s.cell_begin.end(), 0);
  for (std::size_t i = 0; i < p.count(); ++i) {
    const Cell c{to_cell(p.x[i], inverse_side), to_cell(p.y[i], inverse_side), to_cell(p.z[i], inverse_side)};
    s.bucket[i] = bucket_of(c, buckets);
    ++s.cell_begin[s.bucket[i] + 1];
  }
  for (std::size_t b = 0; b < buckets; ++b) s.cell_begin[b + 1] += s.cell_begin[b];
  for (std::size_t i = p.count(); i-- > 0;)
    s.cell_particle[--s.cell_begin[s.bucket[i] + 1]] = static_cast<Index>(i);
  // Each begin[b + 1] now holds the start of bucket b: shift back.
  std::rotate(s.cell_begin.begin(), s.cell_begin.begin() + 1, s.cell_begin.end());
  s.cell_begin[buckets] = static_cast<Index>(p.count());
}

bool joined(const SelfContact& s, Index i, Index j) {
  const auto begin = s.ring.begin() + s.ring_begin[i], end = s.ring.begin() + s.ring_begin[i + 1];
  return std::find(begin, end, j) != end;
}

void offer(const Particles& p, SelfContact& s, Index i, Index j) {
  const float x = p.x[i] - p.x[j], y = p.y[i] - p.y[j], z = p.z[i] - p.z[j];
  const float reach = kSearch * s.radius_m;
  if (j == i || x * x + y * y + z * z > reach * reach || joined(s, i, j)) return;
  const std::size_t at = i * kMaxClose;
  for (std::size_t k = 0; k < s.close_count[i]; ++k) {
    if (s.close[at + k] == j) return;  // two of the 27 cells may share a bucket
  }
  if (s.close_count[i] == kMaxClose) return;
  s.close_m[at + s.close_count[i]] = std::min(s.radius_m, static_cast<float>((s.rest[i] - s.rest[j]).norm()));
  s.close[at + s.close_count[i]++] = j;
}

void find_close(const Particles& p, SelfContact& s, Index i, float inverse_side) {
  s.close_count[i] = 0;
  const Cell c{to_cell(p.x[i], inverse_side), to_cell(p.y[i], inverse_side), to_cell(p.z[i], inverse_side)};
  for (int n = 0; n < 27; ++n) {
    const Cell near{c.x + n % 3 - 1, c.y + n / 3 % 3 - 1, c.z + n / 9 - 1};
    const Index b = bucket_of(near, s.cell_begin.size() - 1);
    for (Index k = s.cell_begin[b]; k < s.cell_begin[b + 1]; ++k) offer(p, s, i, s.cell_particle[k]);
  }
}

float yielding(const Particles& p, const std::vector<std::uint8_t>& touching, std::size_t i) {
  return touching[i] ? p.weight[i] / kTouchingMass : p.weight[i];
}

void correction(const Particles& p, const std::vector<std::uint8_t>& touching, SelfContact& s, std::size_t i) {
  const float own = yielding(p, touching, i);
  float x = 0.0f, y = 0.0f, z = 0.0f;
  int pushes = 0;
  for (std::size_t k = i * kMaxClose; k < i * kMaxClose + s.close_count[i]; ++k) {
    const Index j = s.close[k];
    const float ex = p.x[i] - p.x[j], ey = p.y[i] - p.y[j], ez = p.z[i] - p.z[j];
    const float length = std::sqrt(ex * ex + ey * ey + ez * ez + kTinyLength2);
    if (length >= s.close_m[k]) continue;
    const float share = own / (own + yielding(p, touching, j) + kTinyWeight);
    const float move = share * (s.close_m[k] - length) / length;
    x += move * ex, y += move * ey, z += move * ez;
    ++pushes;
  }
  const float scale = pushes > 1 ? 1.0f / static_cast<float>(pushes) : 1.0f;
  s.dx[i] = scale * x, s.dy[i] = scale * y, s.dz[i] = scale * z;
}

}  // namespace

SelfContact make_self_contact(const geometry::TriMesh& mesh, const Topology& topology, double radius_m) {
  SelfContact s;
  const std::size_t count = mesh.positions.size();
  s.radius_m = static_cast<float>(radius_m);
  s.rest = mesh.positions;
  s.ring_begin.assign(count + 1, 0);
  for (const Edge& e : topology.edges) ++s.ring_begin[e.a + 1], ++s.ring_begin[e.b + 1];
  for (std::size_t i = 0; i < count; ++i) s.ring_begin[i + 1] += s.ring_begin[i];
  s.ring.resize(2 * topology.edges.size());
  std::vector<Index> next(s.ring_begin.begin(), s.ring_begin.end() - 1);
  for (const Edge& e : topology.edges) s.ring[next[e.a]++] = e.b, s.ring[next[e.b]++] = e.a;
  s.cell_begin.assign(std::bit_ceil(2 * count) + 1, 0);
  s.cell_particle.assign(count, 0), s.bucket.assign(count, 0), s.close_count.assign(count, 0);
  s.close.assign(count * kMaxClose, 0), s.close_m.assign(count * kMaxClose, 0.0f);
  for (auto* a : {&s.dx, &s.dy, &s.dz}) a->assign(count, 0.0f);
  return s;
}

void find_close_pairs(const engine::Context& context, const Particles& particles, SelfContact& self) {
  if (!(self.radius_m > 0.0f) || self.travel_m < kFresh * static_cast<double>(self.radius_m)) return;
  self.travel_m = 0.0;
  const float inverse_side = 1.0f / (kSearch * self.radius_m);
  sort_into_buckets(particles, inverse_side, self);
  engine::parallel_for(context, particles.count(), kParticleGrain / 4,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i)
                           find_close(particles, self, static_cast<Index>(i), inverse_side);
                       });
}

void push_apart(const engine::Context& context, const std::vector<std::uint8_t>& touching, SelfContact& self,
                Particles& particles) {
  engine::parallel_for(context, particles.count(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) correction(particles, touching, self, i);
  });
  engine::parallel_for(context, particles.count(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      particles.x[i] += self.dx[i], particles.y[i] += self.dy[i], particles.z[i] += self.dz[i];
    }
  });
}

}  // namespace bodice::cloth
