// Rows of the peers. Slow ones are measured on some of the particles only.
#pragma once

#include <vector>

#include <bench_references/peers.hpp>
#include <bench_references/subject.hpp>

#include "rows.hpp"

namespace bench {

/// A peer and the particles that it is measured on.
struct SampledPeer {
  Peer& peer;
  Cloud coherent, random;

  SampledPeer(Peer& one, const Cloud& ordered, const Cloud& shuffled);
};

/// Prints the peer's error and adds its rows. `truth` has all particles in coherent order; `distances` has
/// room for as many. The rows keep references to all but `truth`.
void add_peer(SampledPeer& sampled, const std::vector<double>& truth, std::vector<float>& distances,
              std::vector<Row>& rows);

}  // namespace bench
