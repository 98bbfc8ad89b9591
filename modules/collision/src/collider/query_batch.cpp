// Queries, a batch at a time: from the caller's arrays to the kernels and back.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "collider/collider_impl.hpp"
#include "model/tolerances.hpp"

namespace bodice::inline v0_1::collision {

namespace {

/// Positions of a batch and their indices in the caller's arrays.
struct alignas(64) GatheredPositions {
  float x[kBatch], y[kBatch], z[kBatch];
  std::uint32_t index[kBatch];
  int count = 0;
};

void copy(const float* from, const GatheredPositions& positions, std::size_t begin, bool in_order,
          float* to) {
  if (in_order) {
    std::memcpy(to, from + begin, static_cast<std::size_t>(positions.count) * sizeof(float));
    return;
  }
  for (int i = 0; i < positions.count; ++i) to[i] = from[positions.index[i]];
}

/// Gathers positions; their indices are left out where they are begin, begin + 1, ...
void gather_positions(const ParticleView& particles, const ParticleSequence& sequence, std::size_t begin,
                      std::size_t end, GatheredPositions& out) {
  out.count = static_cast<int>(end - begin);
  if (!sequence.stored())
    std::memcpy(out.index, sequence.from(begin), static_cast<std::size_t>(out.count) * sizeof(std::uint32_t));
  if (!particles.packed)
    return gather_vectors(particles, particles.strided.position, particles.strided.origin,
                          {sequence.from(begin), begin, out.count}, {out.x, out.y, out.z});
  copy(particles.arrays.x, out, begin, sequence.stored(), out.x);
  copy(particles.arrays.y, out, begin, sequence.stored(), out.y);
  copy(particles.arrays.z, out, begin, sequence.stored(), out.z);
}

/// The comparison is false for NaN, too; it has no branch, so that loops compile to vector code.
bool near(const GatheredPositions& positions, int i) {
  const int x = std::abs(positions.x[i]) < kFarthest_m, y = std::abs(positions.y[i]) < kFarthest_m,
            z = std::abs(positions.z[i]) < kFarthest_m;
  return (x & y & z) != 0;
}

/// Removes positions that floats cannot represent well enough and calls `other` for each; the rest closes up.
template <class Other>
void drop_far(GatheredPositions& positions, Other&& other) {
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
void pad(GatheredPositions& positions) {
  const int end = (positions.count + kBlock - 1) / kBlock * kBlock;
  for (float* values : {positions.x, positions.y, positions.z})
    std::fill(values + positions.count, values + end, values[positions.count - 1]);
}

/// Takes position i alone.
void take(const GatheredPositions& positions, int i, GatheredPositions& out) {
  out.x[0] = positions.x[i];
  out.y[0] = positions.y[i];
  out.z[0] = positions.z[i];
  out.index[0] = positions.index[i];
  out.count = 1;
  pad(out);
}

}  // namespace

CacheAccess Collider::Impl::cache_access_of(const ParticleView& particles, std::size_t begin, std::size_t end,
                                            WorkspaceData* workspace) const {
  if (!workspace || (end - begin != kBatch && end != particles.count) || begin % kBatch != 0) return {};
  const auto share = [&](double of_size) { return static_cast<float>(of_size * field.size_m()); };
  return {workspace->candidates.batch(begin / kBatch), workspace->candidates.traveled_m(), share(kLeastReach),
          share(kMostReach)};
}

NextBatch Collider::Impl::next_batch_of(const ParticleView& particles, std::size_t begin,
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
  if (const StridedVectors& at = particles.strided.position; !particles.packed) {
    // Structures of three floats fill the memory that three arrays would take.
    if (particles.strided.element || at.is_double || at.stride != 3 * sizeof(float)) return next;
    const auto* const first = reinterpret_cast<const float*>(at.x) + 3 * begin;
    next.x = first;
    next.y = first + next.count;
    next.z = first + 2 * next.count;
    return next;
  }
  next.x = particles.arrays.x + begin;
  next.y = particles.arrays.y + begin;
  next.z = particles.arrays.z + begin;
  return next;
}

namespace {

/// The batch of some gathered positions; one of them alone is copied, because its block must be full.
Positions view_of(const GatheredPositions& positions, LaneSpan lanes, GatheredPositions& alone) {
  const auto from = static_cast<std::size_t>(lanes.begin);
  if (lanes.size() > 1) return {positions.x + from, positions.y + from, positions.z + from, lanes.size()};
  take(positions, lanes.begin, alone);
  return {alone.x, alone.y, alone.z, 1};
}

}  // namespace

void Collider::Impl::query_range(const ParticleView& particles, std::size_t begin, std::size_t end,
                                 const ParticleSequence& sequence, const QueryOptions& options,
                                 std::span<Contact> contacts) const {
  const int all = static_cast<int>(end - begin);
  const bool exact = options.accuracy == Accuracy::kExact;
  const Particles& arrays = particles.arrays;
  const bool in_place = sequence.stored() && particles.packed && all == kBatch;
  Batch batch{
      .at = in_place ? Positions{arrays.x + begin, arrays.y + begin, arrays.z + begin, all} : Positions{},
      .cache = cache_access_of(particles, begin, end, sequence.workspace),
      // A first-order query stores contacts in each step, and prefetching more of them would hold up
      // these stores.
      .next = next_batch_of(particles, end, sequence, exact ? contacts.data() : nullptr)};
  ContactOutput out{.contacts = contacts.data() + begin,
                    .margin_m = static_cast<float>(margin_m),
                    .within_m = options.within_m};
  const auto kernel = [&](std::size_t first_block) {
    const Status status = query_batch(model, options.accuracy, batch, out);
    const int blocks = (batch.at.count + kBlock - 1) / kBlock;
    for (int i = 0; sequence.workspace && status == Status::kDone && i < blocks; ++i)
      sequence.workspace->order.note_radius(first_block + static_cast<std::size_t>(i), batch.radius_m[i]);
    return status;
  };
  if (in_place && field.size() > 0 && kernel(begin / kBlock) == Status::kDone) return;
  GatheredPositions positions, alone;
  gather_positions(particles, sequence, begin, end, positions);
  const auto exactly = [&](int i) {
    const Contact found =
        exact_contact({double{positions.x[i]}, double{positions.y[i]}, double{positions.z[i]}});
    contacts[positions.index[i]] = found.signed_distance <= options.within_m ? found : no_contact();
  };
  const auto number = [&] {
    if (sequence.stored())
      std::iota(positions.index, positions.index + positions.count, static_cast<std::uint32_t>(begin));
  };
  if (field.size() == 0) {
    number();
    for (int i = 0; i < positions.count; ++i) exactly(i);
    return;
  }
  pad(positions);
  const bool in_order = sequence.stored() && !in_place;
  if (in_order) {  // then contacts are so, too, which are written faster than those of an index
    batch.at = view_of(positions, {0, positions.count}, alone);
    if (kernel(begin / kBlock) == Status::kDone) return;
  }
  number();
  out.contacts = contacts.data();
  const auto gathered = [&](LaneSpan lanes) {
    batch.at = view_of(positions, lanes, alone);
    out.index = positions.index + lanes.begin;
    return kernel((begin + static_cast<std::size_t>(lanes.begin)) / kBlock);
  };
  if (!in_place && !in_order && gathered({0, positions.count}) == Status::kDone) return;
  batch.cache = {};
  batch.next = {};
  // Either the candidates overflowed, which those of single blocks may not, or some particles are too far
  // away for floats.
  drop_far(positions, exactly);
  if (positions.count == 0) return;
  pad(positions);
  // Whether floats suffice for a particle must not depend on its neighbors.
  constexpr int kSizes[] = {1};
  for (int from = 0; from < positions.count; from += kBlock)
    with_fallback({from, std::min(from + kBlock, positions.count)}, kSizes, gathered, [&](LaneSpan lanes) {
      exactly(lanes.begin);
      return Status::kDone;
    });
}

}  // namespace bodice::collision
