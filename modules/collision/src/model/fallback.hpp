// What follows when the lists of a kernel overflow.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

namespace bodice::inline v0_1::collision {

/// Outcome of an evaluation.
enum class Status : std::uint8_t {
  kDone,
  kTooMany,  ///< more candidates or pairs than the lists hold
  kTooFar    ///< a particle is not within kFarthest_m
};

/// The lanes [begin, end) of a batch.
struct LaneSpan {
  int begin = 0, end = 0;

  int size() const { return end - begin; }
};

/// Calls `work` (span of lanes, returns a Status) for all lanes together and, where these are too many, for
/// parts of each size in turn. Parts of the last size that are still too many go to `last`. Stops at the
/// first span that does not end with kDone.
template <class Work, class Last>
Status with_fallback(LaneSpan lanes, std::span<const int> sizes, Work&& work, Last&& last) {
  const Status status = work(lanes);
  if (status != Status::kTooMany) return status;
  while (!sizes.empty() && lanes.size() <= sizes.front()) sizes = sizes.subspan(1);
  if (sizes.empty()) return last(lanes);
  for (int begin = lanes.begin; begin < lanes.end; begin += sizes.front()) {
    const LaneSpan part = {begin, std::min(begin + sizes.front(), lanes.end)};
    const Status of_part = with_fallback(part, sizes.subspan(1), work, last);
    if (of_part != Status::kDone) return of_part;
  }
  return Status::kDone;
}

}  // namespace bodice::collision
