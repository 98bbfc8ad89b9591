// Queries, a batch at a time: from the caller's arrays to the kernel and back.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "collider/collider_impl.hpp"
#include "model/tolerances.hpp"

namespace bodice::collision {

namespace {

/// A batch of places and whose they are.
struct alignas(64) Places {
  float x[kBatch], y[kBatch], z[kBatch];
  std::uint32_t index[kBatch];
  int count = 0;
};

void copy(const float* from, const Places& places, std::size_t begin, bool in_order, float* to) {
  if (in_order) {
    std::memcpy(to, from + begin, static_cast<std::size_t>(places.count) * sizeof(float));
    return;
  }
  for (int i = 0; i < places.count; ++i) to[i] = from[places.index[i]];
}

void collect(const Particles& particles, const Sequence& sequence, std::size_t begin, std::size_t end,
             Places& out) {
  out.count = static_cast<int>(end - begin);
  if (sequence.stored())
    std::iota(out.index, out.index + out.count, static_cast<std::uint32_t>(begin));
  else
    std::memcpy(out.index, sequence.from(begin), static_cast<std::size_t>(out.count) * sizeof(std::uint32_t));
  copy(particles.x, out, begin, sequence.stored(), out.x);
  copy(particles.y, out, begin, sequence.stored(), out.y);
  copy(particles.z, out, begin, sequence.stored(), out.z);
}

/// Also false for NaN. Without branches, for loops of vectors.
bool near(const Places& places, int i) {
  const int x = std::abs(places.x[i]) < kFarthest, y = std::abs(places.y[i]) < kFarthest,
            z = std::abs(places.z[i]) < kFarthest;
  return (x & y & z) != 0;
}

/// Takes out what floats cannot handle, calling `other` for it; the rest closes up.
template <class Other>
void keep_near(Places& places, Other&& other) {
  int kept = 0;
  for (int i = 0; i < places.count; ++i) {
    if (!near(places, i)) {
      other(i);
      continue;
    }
    places.x[kept] = places.x[i];
    places.y[kept] = places.y[i];
    places.z[kept] = places.z[i];
    places.index[kept++] = places.index[i];
  }
  places.count = kept;
}

/// Repeats the last place up to a whole block.
void pad(Places& places) {
  const int end = (places.count + kBlock - 1) / kBlock * kBlock;
  for (float* values : {places.x, places.y, places.z})
    std::fill(values + places.count, values + end, values[places.count - 1]);
}

/// Place i only.
void take(const Places& places, int i, Places& out) {
  out.x[0] = places.x[i];
  out.y[0] = places.y[i];
  out.z[0] = places.z[i];
  out.index[0] = places.index[i];
  out.count = 1;
  pad(out);
}

}  // namespace

bool Collider::Impl::query_kernel(QueryBatch& batch, std::size_t block, Memory* memory) const {
  if (!query_batch(baked, tables(), batch)) return false;
  const std::size_t blocks = static_cast<std::size_t>((batch.count + kBlock - 1) / kBlock);
  for (std::size_t i = 0; memory && i < blocks; ++i) memory->order.note_radius(block + i, batch.radius_m[i]);
  return true;
}

Keeping Collider::Impl::keeping_of(const Particles& particles, std::size_t begin, std::size_t end,
                                   Memory* memory) const {
  if (!memory || (end - begin != kBatch && end != particles.count) || begin % kBatch != 0) return {};
  const auto share = [&](double of_size) { return static_cast<float>(of_size * field.size_m()); };
  return {&memory->candidates.batch(begin / kBatch), memory->candidates.traveled_m(), share(kLeastReach),
          share(kMostReach)};
}

Ahead Collider::Impl::ahead_of(const Particles& particles, std::size_t begin, const Sequence& sequence,
                               Contact* contacts) {
  Ahead next;
  const std::size_t last = sequence.stored() ? particles.count : sequence.first + sequence.order.size();
  if (begin >= last) return next;
  next.count = static_cast<int>(std::min<std::size_t>(kBatch, last - begin));
  if (sequence.memory && begin % kBatch == 0) next.kept = &sequence.memory->candidates.batch(begin / kBatch);
  next.index = sequence.from(begin);
  next.contacts = contacts && sequence.stored() ? contacts + begin : contacts;
  if (!sequence.stored()) return next;
  next.x = particles.x + begin;
  next.y = particles.y + begin;
  next.z = particles.z + begin;
  return next;
}

void Collider::Impl::query_some(const Particles& particles, std::size_t begin, std::size_t end,
                                const Sequence& sequence, const QueryOptions& options,
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
                   .keeping = keeping_of(particles, begin, end, sequence.memory)};
  batch.ahead = ahead_of(particles, end, sequence, contacts.data());
  const bool in_place = sequence.stored() && all == kBatch;
  if (in_place && field.size() > 0 && query_kernel(batch, begin / kBlock, sequence.memory)) return;
  Places places;
  collect(particles, sequence, begin, end, places);
  const auto exactly = [&](int i) {
    const Contact found = exact_contact({double{places.x[i]}, double{places.y[i]}, double{places.z[i]}});
    contacts[places.index[i]] = found.signed_distance <= options.within_m ? found : no_contact();
  };
  if (field.size() == 0) {
    for (int i = 0; i < places.count; ++i) exactly(i);
    return;
  }
  batch.contacts = contacts.data();
  const auto kernel = [&](int from, int count) {
    batch.x = places.x + from, batch.y = places.y + from, batch.z = places.z + from;
    batch.index = places.index + from;
    batch.count = count;
    return query_kernel(batch, (begin + static_cast<std::size_t>(from)) / kBlock, sequence.memory);
  };
  pad(places);
  if (!in_place && kernel(0, places.count)) return;
  batch.keeping = {};
  batch.ahead = {};
  // Too many ellipsoids near for a batch may do for its blocks; or some places are too far for floats.
  keep_near(places, exactly);
  if (places.count == 0) return;
  pad(places);
  for (int from = 0; from < places.count; from += kBlock) {
    const int to = std::min(from + kBlock, places.count);
    if (kernel(from, to - from)) continue;
    // Whether floats answer a particle must not depend on its neighbors.
    for (int i = from; i < to; ++i) {
      Places alone;
      take(places, i, alone);
      batch.x = alone.x, batch.y = alone.y, batch.z = alone.z;
      batch.index = alone.index;
      batch.count = 1;
      if (!query_kernel(batch, 0, nullptr)) exactly(i);
    }
  }
}

}  // namespace bodice::collision
