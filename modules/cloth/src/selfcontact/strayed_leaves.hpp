// Leaves with particles that strayed from their expected paths. Their groups are listed anew, while all
// others are kept: where a body pulls at a garment, a few particles of ten thousand stray in each substep.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/particles.hpp"
#include "pairs/pairs.hpp"

namespace bodice::inline v0_1::cloth {

struct SelfContact;

/// A group that is to be listed: its leaves, the lower one first.
struct WantedGroup {
  std::uint32_t task = 0, leaf = 0, other = 0;

  auto operator<=>(const WantedGroup&) const = default;
};

/// Leaves that strayed, and what they need.
struct StrayedLeaves {
  std::vector<Index> particles;
  std::vector<std::uint32_t> leaves;
  std::vector<WantedGroup> wanted;
  std::vector<PairGroup> groups;  ///< room for those of one task
  std::size_t listed = 0;         ///< groups that were listed since the last search
};

/// Room for a garment, so that frames allocate nothing.
StrayedLeaves make_strayed_leaves(std::size_t particles, const ContactMesh& mesh);

/// Lists the further groups of leaves with particles that are farther off their expected paths than `most_m`,
/// as strays() found, and allows these particles to be as far from there. Returns false, with nothing listed,
/// where so many strayed that all groups should be searched anew, or where the tree does not have the sweeps
/// of the last search. Cost: O(#P), and O(log #leaves) for each leaf that strayed and each group near it.
bool list_strayed(float since_s, float most_m, SelfContact& self);

}  // namespace bodice::cloth
