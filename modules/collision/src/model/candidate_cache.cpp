#include "model/candidate_cache.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "model/surface_motion.hpp"

namespace bodice::inline v0_1::collision {

namespace {

using geometry::Ellipsoid;

static_assert(sizeof(Ellipsoid) == 15 * sizeof(double), "shapes are compared as bytes");

constexpr double kWidened = 1.001;  // covers the rounding of one step

double farthest_travel(std::span<const Ellipsoid> before, std::span<const Ellipsoid> now) {
  double most_m = 0.0;
  for (std::size_t k = 0; k < now.size(); ++k)
    most_m = std::max(most_m, travel_between(material_of(before[k]), material_of(now[k])));
  return most_m;
}

}  // namespace

bool CachedBatch::begin_refresh(float least_reach_m, float most_reach_m) {
  if (rest > 0) {
    --rest;
    return false;
  }
  if (reach_m == 0.0f) reach_m = 0.5f * most_reach_m;
  const bool far = reach_m >= most_reach_m;
  if (count > 0 && used < kLeastUse && far) {
    give_up();
    return false;
  }
  if (count > 0 && used < kShortLife) reach_m *= 2.0f;
  if (count > 0 && used > kLongLife) reach_m *= 0.5f;
  reach_m = std::clamp(reach_m, least_reach_m, most_reach_m);
  count = used = 0;
  return true;
}

void CandidateCache::clear() {
  for (CachedBatch& batch : batches_) batch.count = 0;
  traveled_m_ = 0.0;
}

void CandidateCache::begin_call(std::size_t particles, std::span<const Ellipsoid> shapes, float beyond_m) {
  if (!std::exchange(first_call_, false)) batches_.resize((particles + kBatch - 1) / kBatch);
  const bool same_number = shapes_.size() == shapes.size();
  if (same_number && beyond_m == beyond_m_ &&
      std::memcmp(shapes.data(), shapes_.data(), shapes.size_bytes()) == 0)
    return;
  if (same_number) traveled_m_ += kWidened * farthest_travel(shapes_, shapes);
  if (!same_number || beyond_m != beyond_m_ || !std::isfinite(traveled_m_)) clear();
  shapes_.assign(shapes.begin(), shapes.end());
  beyond_m_ = beyond_m;
}

}  // namespace bodice::collision
