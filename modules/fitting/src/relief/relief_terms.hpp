// The ellipsoids that contribute to the distance at a sample, each with its share of the blended distance:
// eq. (5) of proxy_distance.hpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/proxy/proxy_distance.hpp>

#include "relief/relief_samples.hpp"

namespace bodice::inline v0_1::fitting {

/// The contribution of one ellipsoid's table to the distance at one sample.
struct ReliefTerm {
  std::uint32_t sample = 0;
  float share = 0.0f;         ///< W_k / sum W
  float slope_factor = 0.0f;  ///< clamp(d) / reach.out, the factor of the table's a
  Eigen::Vector3f direction = Eigen::Vector3f::UnitX();  ///< w, the unit vector of the closest point
};

/// The terms grouped by ellipsoid, samples ascending, with the sums that they should have:
/// sum_k share_k (h_k + a_k factor_k) = sum_k share_k d_k - s.
struct ReliefTerms {
  std::vector<std::size_t> begin;         ///< #E + 1: terms of ellipsoid k are begin[k]..begin[k+1]
  std::vector<ReliefTerm> term;           ///< #T
  std::vector<std::size_t> of_begin;      ///< #S + 1: where each sample's indices begin in `of`
  std::vector<std::uint32_t> of;          ///< #T: indices into `term` of each sample's terms
  std::vector<double> target_m;           ///< #S: the right side above
  std::vector<double> signed_distance_m;  ///< #S: s
  std::vector<float> weight;              ///< #S; zero: the sample does not count
};

/// Finds the terms by exact distances to the ellipsoids that can be near a block of neighboring samples.
/// Deterministic, parallel. About a microsecond a sample with 89 ellipsoids.
ReliefTerms find_terms(const engine::Context& context, std::span<const ReliefSample> samples,
                       std::span<const proxy::ProxyEllipsoid> ellipsoids, const proxy::ReliefReach& reach);

/// The terms of both sets of samples; the samples of `more` follow those of `terms`.
ReliefTerms joined(const ReliefTerms& terms, const ReliefTerms& more);

}  // namespace bodice::fitting
