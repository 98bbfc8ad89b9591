// Leaves with particles that strayed, that is, deviate from their expected paths by more than is allowed.
// Their groups alone are listed anew: where a body pulls at a garment, a few particles of ten thousand stray
// in each substep.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/particles.hpp"
#include "pairs/pairs.hpp"

namespace bodice::inline v0_1::cloth {

struct SelfContact;

/// A group that a task lacks: the task and the two leaves, the lower one first.
struct WantedGroup {
  std::uint32_t task = 0, leaf = 0, other = 0;

  auto operator<=>(const WantedGroup&) const = default;
};

/// The particles that strayed, their leaves, and the groups that these leaves lack.
struct StrayedLeaves {
  std::vector<Index> particles;
  std::vector<std::uint32_t> leaves;
  std::vector<WantedGroup> wanted;
  std::vector<PairGroup> groups;  ///< room for those of one task
  std::size_t listed = 0;         ///< number of groups that were listed since the last search
};

/// Room for a garment, so that frames allocate nothing.
StrayedLeaves make_strayed_leaves(std::size_t particles, const ContactMesh& mesh);

/// Lists the groups that the leaves of strayed particles lack, and raises these particles' allowance
/// (ExpectedPaths::allowance_m) to their deviation. A particle strayed if its deviation, from
/// measure_deviations(), exceeds `most_m` plus its allowance. Returns false and lists nothing where a search
/// of all groups is due instead: many particles strayed, one is very far, or the tree lacks the sweeps of the
/// last search. Cost: O(#P), and O(log #leaves) for each leaf that strayed and each group near it.
bool list_groups_of_strayed(float since_s, float most_m, SelfContact& self);

}  // namespace bodice::cloth
