// Contenders, which find the distance from particles to the skin: proxies with different settings, and peers.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <bodice/collision/collider.hpp>
#include <bodice/fitting/fit.hpp>

#include "bodies.hpp"

namespace tradeoff {

inline constexpr double kFrameParticles = 1e4;  ///< particles of the frame that times are given for

/// A method that finds distances, with its costs.
struct Contender {
  std::string kind;               ///< the tier, or the peer
  std::string setting;            ///< the count, target error or cell size
  bool ours = false;              ///< whether it is a proxy of bodice
  bool has_sign = true;           ///< whether distances are signed
  double size = 0.0;              ///< number of ellipsoids or capsules; 0: neither
  double bytes = 0.0;             ///< 0: not known
  double prepare_ms = 0.0;        ///< time from the segmented skin to the first query
  double update_us = 0.0;         ///< time a frame for a moving body
  std::size_t particles = 0;      ///< particles of a query or response
  std::function<void()> query;    ///< queries all particles once
  std::function<void()> respond;  ///< pushes all particles out once; empty: there is no response
  std::function<std::vector<float>()> distances_m;
};

/// A proxy of bodice, queried by the collider that the frame path uses. Responses are always exact; there is
/// none to first order.
Contender of_proxy(const Subject& subject, const bodice::fitting::FitResult& fit, std::string setting,
                   bodice::collision::Accuracy accuracy = bodice::collision::Accuracy::kExact);

/// The peers: Embree where it is installed, distance grids, and a capsule a part.
std::vector<Contender> peers(const Subject& subject, const std::vector<double>& grid_cells_m);

/// The least processor time of a call, over five batches, because the clock counts microseconds.
double least_us(const std::function<void()>& work, int batch = 50);

/// The time of a fit without the measurement of its accuracy.
double fit_ms(const bodice::fitting::FitResult& fit);

/// The processor time of a contender, nanoseconds a particle.
struct Cost {
  double query_ns = 0.0, response_ns = 0.0;  ///< the response's is 0 if there is none
};
/// The least times over rounds in which the contenders take turns, so that a slow minute affects all alike.
std::vector<Cost> time_all(const std::vector<Contender>& contenders, int rounds);

}  // namespace tradeoff
