// Queries, a batch at a time: from the caller's arrays to the kernel and back.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "collider_impl.hpp"
#include "tolerances.hpp"

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

void collect(const Particles& particles, std::span<const std::uint32_t> order, std::size_t begin,
             std::size_t end, Places& out) {
  out.count = static_cast<int>(end - begin);
  if (order.empty())
    std::iota(out.index, out.index + out.count, static_cast<std::uint32_t>(begin));
  else
    std::memcpy(out.index, order.data() + begin, static_cast<std::size_t>(out.count) * sizeof(std::uint32_t));
  copy(particles.x, out, begin, order.empty(), out.x);
  copy(particles.y, out, begin, order.empty(), out.y);
  copy(particles.z, out, begin, order.empty(), out.z);
}

/// Also false for NaN.
bool near(const Places& places, int i) {
  return (std::abs(places.x[i]) < kFarthest) & (std::abs(places.y[i]) < kFarthest) &
         (std::abs(places.z[i]) < kFarthest);
}

/// Without a branch, so that it compiles to vector code.
bool all_near(const Places& places) {
  int count = 0;
  for (int i = 0; i < places.count; ++i) count += near(places, i);
  return count == places.count;
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

}  // namespace

void Collider::Impl::query_some(const Particles& particles, std::size_t begin, std::size_t end,
                                std::span<Contact> contacts, ParticleOrder* order) const {
  Places places;
  collect(particles, order ? order->order() : std::span<const std::uint32_t>(), begin, end, places);
  const auto exactly = [&](int i) {
    contacts[places.index[i]] =
        exact_contact({double{places.x[i]}, double{places.y[i]}, double{places.z[i]}});
  };
  if (field.size() == 0) {
    for (int i = 0; i < places.count; ++i) exactly(i);
    return;
  }
  if (!all_near(places)) keep_near(places, exactly);
  if (places.count == 0) return;
  pad(places);
  const auto kernel = [&](int from, int count) {
    QueryBatch batch{.x = places.x + from,
                     .y = places.y + from,
                     .z = places.z + from,
                     .index = places.index + from,
                     .count = count,
                     .margin_m = static_cast<float>(margin_m),
                     .contacts = contacts.data(),
                     .radius_m = {}};
    if (!query_batch(baked, tables(), batch)) return false;
    for (int block = 0; order && block * kBlock < count; ++block)
      order->note_radius(begin / kBlock + static_cast<std::size_t>(from / kBlock + block),
                         batch.radius_m[block]);
    return true;
  };
  if (kernel(0, places.count)) return;
  // Too many ellipsoids near for a batch may do for its blocks.
  for (int from = 0; from < places.count; from += kBlock) {
    const int to = std::min(from + kBlock, places.count);
    if (kernel(from, to - from)) continue;
    for (int i = from; i < to; ++i) exactly(i);
  }
}

}  // namespace bodice::collision
