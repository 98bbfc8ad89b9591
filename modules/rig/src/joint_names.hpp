// What joints are called in common conventions, brought to one name each.
#pragma once

#include <string>
#include <vector>

#include <bodice/rig/skeleton.hpp>

namespace bodice::inline v0_1::rig {

/// The common name of each joint, #J, each used once: of several joints with one name the first has it, the
/// others get an empty one. What a name means may depend on the others: where a collar is named, a shoulder
/// is an upper arm.
std::vector<std::string> common_joint_names(const Skeleton& skeleton);

}  // namespace bodice::rig
