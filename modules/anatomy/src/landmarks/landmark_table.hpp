// The table of all kinds of landmarks.
#pragma once

#include <span>

#include "landmarks/base/landmark_kind.hpp"

namespace bodice::inline v0_1::anatomy {

/// Every kind once, in the order in which landmarks are refined.
std::span<const LandmarkKind> landmark_kinds();

/// Calls visit(kind, side) for every kind and for each side that it has.
template <class Visit>
void for_each_landmark(Visit visit) {
  for (const LandmarkKind& kind : landmark_kinds())
    for (int side = 0; side <= static_cast<int>(kind.paired); ++side) visit(kind, side);
}

}  // namespace bodice::anatomy
