// The vertex with the best signature.
#pragma once

#include <cmath>
#include <limits>

#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::anatomy {

/// How far around the best vertex its neighbors share in the position, a fraction of the body size.
inline constexpr double kSoftRadius = 0.05;

/// The vertex found, and how well it fits.
struct NearestSignature {
  geometry::Index vertex = 0;
  float mahalanobis = std::numeric_limits<float>::infinity();  ///< in deviations among bodies
};

/// The vertex with the least distance2(v) among those that may be it; the lowest among equals. If none may,
/// the best of all. Distances that are not finite never win. O(count).
template <class May, class Distance2>
NearestSignature nearest_signature(const engine::Context& context, std::size_t count, May may,
                                   Distance2 distance2) {
  constexpr std::size_t kGrain = 4096;
  const auto search = [&](auto allowed) {
    return engine::ordered_reduce(
        context, count, kGrain, NearestSignature{},
        [&](std::size_t begin, std::size_t end) {
          NearestSignature best;
          for (std::size_t v = begin; v < end; ++v) {
            if (!allowed(v)) continue;
            const float d = distance2(v);
            if (d < best.mahalanobis) best = {static_cast<geometry::Index>(v), d};
          }
          return best;
        },
        [](NearestSignature a, NearestSignature b) { return b.mahalanobis < a.mahalanobis ? b : a; });
  };
  NearestSignature best = search(may);
  if (!std::isfinite(best.mahalanobis)) best = search([](std::size_t) { return true; });
  best.mahalanobis = std::sqrt(best.mahalanobis);
  return best;
}

}  // namespace bodice::anatomy
