// Queries, a batch at a time: from the caller's arrays to the kernels and back.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "collider/collider_impl.hpp"
#include "model/tolerances.hpp"

namespace bodice::collision {

namespace {

/// Positions of a batch and their indices in the caller's arrays.
struct alignas(64) Positions {
  float x[kBatch], y[kBatch], z[kBatch];
  std::uint32_t index[kBatch];
  int count = 0;
};

void copy(const float* from, const Positions& positions, std::size_t begin, bool in_order, float* to) {
  if (in_order) {
    std::memcpy(to, from + begin, static_cast<std::size_t>(positions.count) * sizeof(float));
    return;
  }
  for (int i = 0; i < positions.count; ++i) to[i] = from[positions.index[i]];
}

void gather_positions(const Particles& particles, const ParticleSequence& sequence, std::size_t begin,
                      std::size_t end, Positions& out) {
  out.count = static_cast<int>(end - begin);
  if (sequence.stored())
    std::iota(out.index, out.index + out.count, static_cast<std::uint32_t>(begin));
  else
    std::memcpy(out.index, sequence.from(begin), static_cast<std::size_t>(out.count) * sizeof(std::uint32_t));
  copy(particles.x, out, begin, sequence.stored(), out.x);
  copy(particles.y, out, begin, sequence.stored(), out.y);
  copy(particles.z, out, begin, sequence.stored(), out.z);
}

/// The comparison is false for NaN, too; it has no branch, so that loops compile to vector code.
bool near(const Positions& positions, int i) {
  const int x = std::abs(positions.x[i]) < kFarthest_m, y = std::abs(positions.y[i]) < kFarthest_m,
            z = std::abs(positions.z[i]) < kFarthest_m;
  return (x & y & z) != 0;
}

/// Removes positions that floats cannot represent well enough and calls `other` for each; the rest closes up.
template <class Other>
void drop_far(Positions& positions, Other&& other) {
  int kept = 0;
  for (int i = 0; i < positions.count; ++i) {
    if (!near(positions, i)) {
      other(i);
      continue;
    }
    positions.x[kept] = positions.x[i];
    positions.y[kept] = positions.y[i];
    positions.z[kept] = positions.z[i];
    positions.index[kept++] = positions.index[i];
  }
  positions.count = kept;
}

/// Repeats the last position until the block is full.
void pad(Positions& positions) {
  const int end = (positions.count + kBlock - 1) / kBlock * kBlock;
  for (float* values : {positions.x, positions.y, positions.z})
    std::fill(values + positions.count, values + end, values[positions.count - 1]);
}

/// Takes position i alone.
void take(const Positions& positions, int i, Positions& out) {
  out.x[0] = positions.x[i];
  out.y[0] = positions.y[i];
  out.z[0] = positions.z[i];
  out.index[0] = positions.index[i];
  out.count = 1;
  pad(out);
}

}  // namespace

bool Collider::Impl::query_kernel(QueryBatch& batch, std::size_t block, WorkspaceData* workspace) const {
  if (!query_batch(baked, tables(), batch)) return false;
  const std::size_t blocks = static_cast<std::size_t>((batch.count + kBlock - 1) / kBlock);
  for (std::size_t i = 0; workspace && i < blocks; ++i)
    workspace->order.note_radius(block + i, batch.radius_m[i]);
  return true;
}

CacheAccess Collider::Impl::cache_access_of(const Particles& particles, std::size_t begin, std::size_t end,
                                            WorkspaceData* workspace) const {
  if (!workspace || (end - begin != kBatch && end != particles.count) || begin % kBatch != 0) return {};
  const auto share = [&](double of_size) { return static_cast<float>(of_size * field.size_m()); };
  return {workspace->candidates.batch(begin / kBatch), workspace->candidates.traveled_m(), share(kLeastReach),
          share(kMostReach)};
}

NextBatch Collider::Impl::next_batch_of(const Particles& particles, std::size_t begin,
                                        const ParticleSequence& sequence, Contact* contacts) {
  NextBatch next;
  const std::size_t last = sequence.stored() ? particles.count : sequence.first + sequence.order.size();
  if (begin >= last) return next;
  next.count = static_cast<int>(std::min<std::size_t>(kBatch, last - begin));
  if (sequence.workspace && begin % kBatch == 0)
    next.cached = sequence.workspace->candidates.batch(begin / kBatch);
  next.index = sequence.from(begin);
  next.contacts = contacts && sequence.stored() ? contacts + begin : contacts;
  if (!sequence.stored()) return next;
  next.x = particles.x + begin;
  next.y = particles.y + begin;
  next.z = particles.z + begin;
  return next;
}

void Collider::Impl::query_range(const Particles& particles, std::size_t begin, std::size_t end,
                                 const ParticleSequence& sequence, const QueryOptions& options,
                                 std::span<Contact> contacts) const {
  const int all = static_cast<int>(end - begin);
  QueryBatch batch{.x = particles.x + begin,
                   .y = particles.y + begin,
                   .z = particles.z + begin,
                   .index = nullptr,
                   .count = all,
                   .margin_m = static_cast<float>(margin_m),
                   .within_m = options.within_m,
                   .accuracy = options.accuracy,
                   .contacts = contacts.data() + begin,
                   .radius_m = {},
                   .cache = cache_access_of(particles, begin, end, sequence.workspace)};
  batch.next_batch = next_batch_of(particles, end, sequence, contacts.data());
  const bool in_place = sequence.stored() && all == kBatch;
  if (in_place && field.size() > 0 && query_kernel(batch, begin / kBlock, sequence.workspace)) return;
  Positions positions;
  gather_positions(particles, sequence, begin, end, positions);
  const auto exactly = [&](int i) {
    const Contact found =
        exact_contact({double{positions.x[i]}, double{positions.y[i]}, double{positions.z[i]}});
    contacts[positions.index[i]] = found.signed_distance <= options.within_m ? found : no_contact();
  };
  if (field.size() == 0) {
    for (int i = 0; i < positions.count; ++i) exactly(i);
    return;
  }
  batch.contacts = contacts.data();
  const auto kernel = [&](int from, int count) {
    batch.x = positions.x + from, batch.y = positions.y + from, batch.z = positions.z + from;
    batch.index = positions.index + from;
    batch.count = count;
    return query_kernel(batch, (begin + static_cast<std::size_t>(from)) / kBlock, sequence.workspace);
  };
  pad(positions);
  if (!in_place && kernel(0, positions.count)) return;
  batch.cache = {};
  batch.next_batch = {};
  // Either the candidates overflowed, which those of single blocks may not, or some particles are too far
  // away for floats.
  drop_far(positions, exactly);
  if (positions.count == 0) return;
  pad(positions);
  for (int from = 0; from < positions.count; from += kBlock) {
    const int to = std::min(from + kBlock, positions.count);
    if (kernel(from, to - from)) continue;
    // Whether floats suffice for a particle must not depend on its neighbors.
    for (int i = from; i < to; ++i) {
      Positions alone;
      take(positions, i, alone);
      batch.x = alone.x, batch.y = alone.y, batch.z = alone.z;
      batch.index = alone.index;
      batch.count = 1;
      if (!query_kernel(batch, 0, nullptr)) exactly(i);
    }
  }
}

}  // namespace bodice::collision
