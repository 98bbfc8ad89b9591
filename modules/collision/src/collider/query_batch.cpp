// Queries, a batch at a time: from the caller's arrays to the kernels and back.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "collider/collider_impl.hpp"
#include "model/tolerances.hpp"

namespace bodice::inline v0_1::collision {

/// Positions of a batch and their indices in the caller's arrays.
struct alignas(64) GatheredPositions {
  float x[kBatch], y[kBatch], z[kBatch];
  std::uint32_t index[kBatch];
  int count = 0;
};

namespace {

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

/// A query of at most kBatch particles, in steps: each takes what the one before left open.
class Collider::Impl::RangeQuery {
 public:
  RangeQuery(const Impl& collider, const ParticleView& particles, const ParticleSequence& sequence,
             const QueryOptions& options, std::span<Contact> contacts)
      : collider_(collider),
        particles_(particles),
        sequence_(sequence),
        options_(options),
        contacts_(contacts),
        out_{.margin_m = static_cast<float>(collider.margin_m), .within_m = options.within_m} {}

  void run(std::size_t begin, std::size_t end) {
    begin_ = begin;
    if (collider_.field.size() == 0) return query_without_ellipsoids(end);
    batch_.cache = collider_.cache_access_of(particles_, begin, end, sequence_.workspace);
    // A first-order query stores contacts in each step, and prefetching more of them would hold up
    // these stores.
    const bool exact = options_.accuracy == Accuracy::kExact;
    batch_.next = next_batch_of(particles_, end, sequence_, exact ? contacts_.data() : nullptr);
    const bool stored = sequence_.stored();
    const bool in_place = stored && particles_.packed && end - begin == kBatch;
    if (in_place && query_in_place() == Status::kDone) return;
    gather_positions(particles_, sequence_, begin, end, positions_);
    pad(positions_);
    if (stored && !in_place && query_in_order() == Status::kDone) return;
    number_positions();
    out_.contacts = contacts_.data();
    if (!stored && query_gathered({0, positions_.count}) == Status::kDone) return;
    query_blocks();
  }

 private:
  void query_without_ellipsoids(std::size_t end) {
    gather_positions(particles_, sequence_, begin_, end, positions_);
    number_positions();
    for (int i = 0; i < positions_.count; ++i) query_exactly(i);
  }

  /// Reads a whole batch where the caller has it.
  Status query_in_place() {
    const Particles& arrays = particles_.arrays;
    batch_.at = {arrays.x + begin_, arrays.y + begin_, arrays.z + begin_, kBatch};
    return query_consecutive();
  }

  /// Reads gathered positions that are consecutive in the caller's arrays.
  Status query_in_order() {
    batch_.at = view_of(positions_, {0, positions_.count}, alone_);
    return query_consecutive();
  }

  /// Contacts of consecutive particles are consecutive, too, and written faster than those of an index.
  Status query_consecutive() {
    out_.contacts = contacts_.data() + begin_;
    return run_kernel(begin_ / kBlock);
  }

  Status query_gathered(LaneSpan lanes) {
    batch_.at = view_of(positions_, lanes, alone_);
    out_.index = positions_.index + lanes.begin;
    return run_kernel((begin_ + static_cast<std::size_t>(lanes.begin)) / kBlock);
  }

  /// Queries block by block. The candidates of the batch overflowed, and those of a block may not, or some
  /// particles are too far away for floats.
  void query_blocks() {
    batch_.cache = {};
    batch_.next = {};
    drop_far(positions_, [&](int i) { query_exactly(i); });
    if (positions_.count == 0) return;
    pad(positions_);
    // Whether floats suffice for a particle must not depend on its neighbors.
    constexpr int kSizes[] = {1};
    for (int from = 0; from < positions_.count; from += kBlock)
      with_fallback(
          {from, std::min(from + kBlock, positions_.count)}, kSizes,
          [&](LaneSpan lanes) { return query_gathered(lanes); },
          [&](LaneSpan lanes) {
            query_exactly(lanes.begin);
            return Status::kDone;
          });
  }

  void query_exactly(int i) {
    const Contact found =
        collider_.exact_contact({double{positions_.x[i]}, double{positions_.y[i]}, double{positions_.z[i]}});
    contacts_[positions_.index[i]] = found.signed_distance <= options_.within_m ? found : no_contact();
  }

  /// Gives consecutive positions the indices that gather_positions() leaves out.
  void number_positions() {
    if (sequence_.stored())
      std::iota(positions_.index, positions_.index + positions_.count, static_cast<std::uint32_t>(begin_));
  }

  Status run_kernel(std::size_t first_block) {
    const Status status = query_batch(collider_.model, options_.accuracy, batch_, out_);
    const int blocks = (batch_.at.count + kBlock - 1) / kBlock;
    for (int i = 0; sequence_.workspace && status == Status::kDone && i < blocks; ++i)
      sequence_.workspace->order.note_radius(first_block + static_cast<std::size_t>(i), batch_.radius_m[i]);
    return status;
  }

  const Impl& collider_;
  const ParticleView& particles_;
  const ParticleSequence& sequence_;
  const QueryOptions& options_;
  const std::span<Contact> contacts_;
  std::size_t begin_ = 0;
  Batch batch_{};
  ContactOutput out_;
  GatheredPositions positions_, alone_;
};

void Collider::Impl::query_range(const ParticleView& particles, std::size_t begin, std::size_t end,
                                 const ParticleSequence& sequence, const QueryOptions& options,
                                 std::span<Contact> contacts) const {
  RangeQuery(*this, particles, sequence, options, contacts).run(begin, end);
}

}  // namespace bodice::collision
