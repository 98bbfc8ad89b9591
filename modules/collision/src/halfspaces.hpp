// A handful of half-spaces and the nearest point of their intersection: what a contact with several
// ellipsoids comes down to, for positions and (through the origin) for velocities.
// Based on: Clifford Hildreth. A Quadratic Programming Procedure. 1957. (coordinate ascent on the dual)
#pragma once

#include <algorithm>
#include <cstddef>

#include <bodice/geometry/types.hpp>

namespace bodice::collision {

/// { x : normal . x >= offset_m }, the normal of unit length.
struct Halfspace {
  geometry::Vec3 normal;
  double offset_m;
};

/// Up to three half-spaces; three already fix a point of space.
class Halfspaces {
 public:
  static constexpr int kCapacity = 3;

  int size() const { return size_; }
  const Halfspace& operator[](int i) const { return items_[i]; }
  bool full() const { return size_ == kCapacity; }
  void add(const Halfspace& h) {
    if (!full()) items_[size_++] = h;
  }

  /// The same normals with every plane through the origin: the cone of velocities that do not go in.
  Halfspaces cone() const {
    Halfspaces result = *this;
    for (int i = 0; i < size_; ++i) result.items_[i].offset_m = 0.0;
    return result;
  }

  /// The nearest point of the intersection to `p`, to `tolerance`; where the normals nearly oppose each
  /// other it stops short, which violation() tells. At most kSweeps passes over the set.
  geometry::Vec3 project(const geometry::Vec3& p, double tolerance) const {
    double push[kCapacity] = {0.0, 0.0, 0.0};
    geometry::Vec3 x = p;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      double largest = 0.0;
      for (int i = 0; i < size_; ++i) {
        const double step = std::max(-push[i], items_[i].offset_m - items_[i].normal.dot(x));
        push[i] += step;
        x += step * items_[i].normal;
        largest = std::max(largest, std::abs(step));
      }
      if (size_ < 2 || largest <= tolerance) break;
    }
    return x;
  }

 private:
  static constexpr int kSweeps = 32;
  Halfspace items_[kCapacity];
  int size_ = 0;
};

}  // namespace bodice::collision
