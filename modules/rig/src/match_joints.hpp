// Which joint of one skeleton moves which joint of another.
#pragma once

#include <cstddef>
#include <vector>

#include <bodice/rig/skeleton.hpp>

namespace bodice::inline v0_1::rig {

inline constexpr std::size_t kNoIndex = ~std::size_t{0};

/// Fewer shared names than this are no common skeleton: hips, two thighs and one more.
inline constexpr std::size_t kFewestMatched = 4;

struct JointMatch {
  std::vector<std::size_t> source_of;  ///< of each joint of the target, or kNoIndex
  std::vector<std::string> name;  ///< common name of each joint of the target that was matched by its name
  std::size_t source_hips = kNoIndex, target_hips = kNoIndex;
  std::size_t count = 0;  ///< joints matched by name
};

/// Matches joints by equal names, then by common names. A joint of the target between two matched ones (a
/// spine with more joints, a twist bone) follows the last joint of the source that lies as far along the same
/// path, by length at rest.
JointMatch match_joints(const Skeleton& source, const Skeleton& target);

}  // namespace bodice::rig
