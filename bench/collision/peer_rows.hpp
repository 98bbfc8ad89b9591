// Rivals in the table. Slow ones are asked about some of the particles only.
#pragma once

#include <vector>

#include <bench_references/peers.hpp>
#include <bench_references/subject.hpp>

#include "rows.hpp"

namespace bench {

/// A rival and the particles that it is asked about.
struct AskedPeer {
  Peer& peer;
  Cloud coherent, random;

  AskedPeer(Peer& one, const Cloud& ordered, const Cloud& shuffled);
};

/// `truth` of all particles in coherent order; `distances` has room for as many. Prints how far off the
/// answers are; rows keep references to all but `truth`.
void add_peer(AskedPeer& asked, const std::vector<double>& truth, std::vector<float>& distances,
              std::vector<Row>& rows);

}  // namespace bench
