#include "scan/solid.hpp"

#include <algorithm>

#include "scan/props.hpp"

namespace bodice::inline v0_1::synth {

using geometry::Box;
using geometry::Vec3;

void Solid::add(const Solid& other) {
  distance = [a = std::move(distance), b = other.distance](const Vec3& p) { return std::min(a(p), b(p)); };
  box.low = box.low.cwiseMin(other.box.low);
  box.high = box.high.cwiseMax(other.box.high);
}

Solid solid_of(const std::vector<Box>& boxes) {
  Solid solid;
  for (const Box& b : boxes) solid.box.extend(b.low), solid.box.extend(b.high);
  solid.distance = [boxes](const Vec3& p) {
    double least = 1e9;
    for (const Box& b : boxes) least = std::min(least, distance_to_box(b, p));
    return least;
  };
  return solid;
}

}  // namespace bodice::synth
