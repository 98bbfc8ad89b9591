// Matrices of bones in memory of the host, in any of their forms.
#pragma once

#include <span>

#include <bodice/proxy/binding.hpp>

#include "base/outcome.hpp"

namespace bodice::inline v0_1::capi {

/// Checks a pose of `wanted` matrices; `what` names them in sentences, such as "joints".
Outcome check_matrices(const bodice_pose& pose, std::size_t wanted, const char* what);

/// Reads the matrices of a checked pose. Allocates nothing.
void read_matrices(const bodice_pose& pose, std::span<proxy::JointMatrix> out);

}  // namespace bodice::capi
