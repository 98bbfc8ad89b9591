// Whoever can say how far a particle is from the skin: our proxies at a setting of their dials, and rivals.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <bodice/collision/collider.hpp>
#include <bodice/fitting/fit.hpp>

#include "bodies.hpp"

namespace tradeoff {

struct Contender {
  std::string kind;  ///< the tier, or the rival
  std::string dial;  ///< its setting
  bool ours = false;
  bool has_sign = true;
  double size = 0.0;              ///< ellipsoids, capsules; 0: neither
  double bytes = 0.0;             ///< 0: not known
  double prepare_ms = 0.0;        ///< from the segmented skin to the first query
  double update_us = 0.0;         ///< what a body that moves pays a frame
  std::size_t particles = 0;      ///< of one query or response
  std::function<void()> query;    ///< all particles once
  std::function<void()> respond;  ///< pushes all out once; empty: cannot
  std::function<std::vector<float>()> distances_m;
};

/// Our proxy, answering through the collider that the frame path uses. Responses are always exact: to first
/// order it has none.
Contender of_proxy(const Subject& subject, const bodice::fitting::FitResult& fit, std::string dial,
                   bodice::collision::Accuracy accuracy = bodice::collision::Accuracy::kExact);

/// Embree where it is installed, distance grids, a capsule a part.
std::vector<Contender> rivals(const Subject& subject, const std::vector<double>& grid_cells_m);

/// Least processor time of one call, of five batches, because the clock counts in microseconds.
double least_us(const std::function<void()>& work, int batch = 50);

/// The time of the fit proper: not of the measurement of its accuracy.
double fit_ms(const bodice::fitting::FitResult& fit);

/// Least processor time a particle, ns, of interleaved rounds, so that a slow minute hits all alike.
struct Cost {
  double query_ns = 0.0, response_ns = 0.0;  ///< the latter 0 if it cannot
};
std::vector<Cost> time_all(const std::vector<Contender>& contenders, int rounds);

}  // namespace tradeoff
