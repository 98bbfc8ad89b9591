#include "repair/rings.hpp"

namespace bodice::inline v0_1::geometry {

void Rings::begin(Index vertex) {
  ++turn_;
  found_.assign(1, vertex);
  seen_[vertex] = turn_;
  last_ = 0;
}

std::span<const Index> Rings::grow() {
  const std::size_t end = found_.size();
  for (std::size_t i = last_; i < end; ++i)
    for (const Index v : neighbors_.of(found_[i])) {
      if (seen_[v] == turn_) continue;
      seen_[v] = turn_;
      found_.push_back(v);
    }
  last_ = end;
  return std::span<const Index>(found_).subspan(end);
}

}  // namespace bodice::geometry
